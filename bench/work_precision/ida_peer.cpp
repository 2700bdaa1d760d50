// SUNDIALS IDA: variable-order BDF on the index-1 DAE itself, 0 = (f(t, x, y) - x', g(t, x, y) - y), y the outputs of the loops.
#include <cmath>

#include <ida/ida.h>

#include "integration.hpp"
#include "loop_residual.hpp"
#include "sundials_support.hpp"

namespace heerk_rotor::work_precision {
namespace {

class Ida final : public Integration {
 public:
  Ida(const Problem& problem, const Vector& scale, int max_order, double tolerance) : problem_(problem), dae_(problem), n_(dae_.states()) {
    const Index size = n_ + dae_.unknowns();
    Vector kind = Vector::Zero(size), absolute(size);
    kind.head(n_).setOnes();
    absolute << tolerance * scale, tolerance * dae_.nominal();
    x_ = makeVector(Vector::Zero(size), sun_.context);
    xdot_ = makeVector(Vector::Zero(size), sun_.context);
    kind_ = makeVector(kind, sun_.context);
    absolute_ = makeVector(absolute, sun_.context);
    gap_.setZero(dae_.unknowns());
    begin();
    memory_ = IDACreate(sun_.context);
    IDAInit(memory_, residual, 0.0, x_.get(), xdot_.get());
    IDASetErrHandlerFn(memory_, silent, nullptr);
    IDASetUserData(memory_, this);
    IDASVtolerances(memory_, tolerance, absolute_.get());
    IDASetMaxNumSteps(memory_, kMaxSteps);
    IDASetMaxOrd(memory_, max_order);
    IDASetId(memory_, kind_.get());
    IDASetSuppressAlg(memory_, SUNTRUE);
    newton_.setDense(memory_, x_.get(), sun_.context, IDASetLinearSolver);
    states_.resize(n_, problem.instants);
  }

  ~Ida() override { IDAFree(&memory_); }

  bool run() override {
    dae_.evaluations = 0;
    begin();
    if (IDAReInit(memory_, 0.0, x_.get(), xdot_.get()) != IDA_SUCCESS) return false;
    for (Index k = 0; k < problem_.instants; ++k) {
      realtype t = 0.0;
      if (IDASolve(memory_, static_cast<double>(k + 1) * problem_.spacing(), &t, x_.get(), xdot_.get(), IDA_NORMAL) < 0) return false;
      states_.col(k) = viewOf(x_.get()).head(n_);
    }
    IDAGetNumSteps(memory_, &steps_);
    evaluations_ = dae_.evaluations;
    return true;
  }

 private:
  /// Consistent start.
  void begin() {
    viewOf(x_.get()) << dae_.start(), dae_.startUnknowns();
    viewOf(xdot_.get()).setZero();
    dae_.evaluate(0.0, data(x_.get()), data(x_.get()) + n_, data(xdot_.get()), gap_.data());
  }

  static int residual(realtype t, N_Vector x, N_Vector xdot, N_Vector r, void* pointer) {
    auto& self = *static_cast<Ida*>(pointer);
    if (!self.dae_.evaluate(t, data(x), data(x) + self.n_, data(r), data(r) + self.n_)) return 1;
    viewOf(r).head(self.n_) -= viewOf(xdot).head(self.n_);
    return std::isfinite(viewOf(r).sum()) ? 0 : 1;
  }

  Problem problem_;
  LoopResidual dae_;
  Index n_;
  SundialsContext sun_;
  NVector x_, xdot_, kind_, absolute_;
  Vector gap_;
  void* memory_ = nullptr;
  NewtonSolver newton_;
};

}  // namespace

std::vector<Family> idaPeers(const Problem& problem, const Vector& scale, bool quick) {
  const auto family = [&](int max_order, const std::string& setting) {
    return Family{"IDA", setting, tolerances(quick), [=](double tolerance) { return std::make_unique<Ida>(problem, scale, max_order, tolerance); }};
  };
  std::vector<Family> families{family(5, "dense Jacobian")};
  if (!quick) families.push_back(family(2, "dense Jacobian, order up to 2"));
  return families;
}

}  // namespace heerk_rotor::work_precision
