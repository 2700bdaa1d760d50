#pragma once
#include <memory>

#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "stiff_solver.hpp"

namespace heerk_rotor::work_precision {

/// Owners of what SUNDIALS allocates.
struct SundialsContext {
  SundialsContext() { SUNContext_Create(nullptr, &context); }
  ~SundialsContext() { SUNContext_Free(&context); }
  SundialsContext(const SundialsContext&) = delete;
  SundialsContext& operator=(const SundialsContext&) = delete;
  SUNContext context = nullptr;
};

struct SundialsDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
  void operator()(SUNMatrix A) const { SUNMatDestroy(A); }
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};
using NVector = std::unique_ptr<std::remove_pointer_t<N_Vector>, SundialsDeleter>;
using SunMatrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, SundialsDeleter>;
using SunSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, SundialsDeleter>;

NVector makeVector(const Vector& values, SUNContext context);
inline double* data(N_Vector v) { return N_VGetArrayPointer(v); }
inline Out viewOf(N_Vector v) { return Out(data(v), NV_LENGTH_S(v)); }

/// The linear solver of a user who knows the structure: (I - gamma S) z = b by StiffSolver, without a matrix. `gamma` asks the integrator
/// for the present value. For methods whose Jacobian is S this is exact, for others the matrix of a simplified Newton iteration.
struct StructuredSolver {
  StiffSolver* stiff;
  void* integrator;
  int (*gamma)(void*, realtype*);
};
SunSolver makeStructuredSolver(StructuredSolver& content, SUNContext context);

/// Dense matrix and LU of the library.
struct DenseSolver {
  DenseSolver(N_Vector like, SUNContext context)
      : matrix(SUNDenseMatrix(NV_LENGTH_S(like), NV_LENGTH_S(like), context)), solver(SUNLinSol_Dense(like, matrix.get(), context)) {}
  SunMatrix matrix;
  SunSolver solver;
};

/// The linear solver in an integrator's Newton iteration; `set` is the library's function that takes it.
class NewtonSolver {
 public:
  using Set = int (*)(void*, SUNLinearSolver, SUNMatrix);
  void setDense(void* integrator, N_Vector like, SUNContext context, Set set) {
    dense_ = std::make_unique<DenseSolver>(like, context);
    set(integrator, dense_->solver.get(), dense_->matrix.get());
  }
  void setStructured(void* integrator, StiffSolver& stiff, int (*gamma)(void*, realtype*), SUNContext context, Set set) {
    content_ = {&stiff, integrator, gamma};
    structured_ = makeStructuredSolver(content_, context);
    set(integrator, structured_.get(), nullptr);
  }

 private:
  std::unique_ptr<DenseSolver> dense_;
  StructuredSolver content_{};
  SunSolver structured_;
};

/// Messages of failing runs are counted as failures, not printed.
inline void silent(int, const char*, const char*, char*, void*) {}

constexpr long kMaxSteps = 20000000;

}  // namespace heerk_rotor::work_precision
