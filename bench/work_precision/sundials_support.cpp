#include "sundials_support.hpp"

namespace heerk_rotor::work_precision {
namespace {

SUNLinearSolver_Type typeOf(SUNLinearSolver) { return SUNLINEARSOLVER_MATRIX_EMBEDDED; }

int solve(SUNLinearSolver solver, SUNMatrix, N_Vector z, N_Vector b, realtype) {
  const auto& content = *static_cast<StructuredSolver*>(solver->content);
  realtype gamma = 0.0;
  if (content.gamma(content.integrator, &gamma) != 0) return -1;
  content.stiff->setGamma(gamma);
  content.stiff->solve(data(b), data(z));
  return 0;
}

int release(SUNLinearSolver solver) {
  solver->content = nullptr;
  SUNLinSolFreeEmpty(solver);
  return 0;
}

}  // namespace

NVector makeVector(const Vector& values, SUNContext context) {
  NVector v(N_VNew_Serial(values.size(), context));
  viewOf(v.get()) = values;
  return v;
}

SunSolver makeStructuredSolver(StructuredSolver& content, SUNContext context) {
  SunSolver solver(SUNLinSolNewEmpty(context));
  solver->content = &content;
  solver->ops->gettype = typeOf;
  solver->ops->solve = solve;
  solver->ops->free = release;
  return solver;
}

}  // namespace heerk_rotor::work_precision
