// SUNDIALS CVODE: variable-order, variable-step BDF and Adams methods.
#include <cvode/cvode.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integration.hpp"
#include "right_hand_side.hpp"
#include "sundials_support.hpp"

namespace heerk_rotor::work_precision {
namespace {

enum class Corrector { kDense, kStructured, kFixedPoint };

/// BDF of order 3 to 5 is unstable for oscillations within sectors beside the imaginary axis; the library can watch for that or stay below.
enum class Orders { kAll, kDetectLimit, kUpToTwo };

class Cvode final : public Integration {
 public:
  Cvode(const Problem& problem, const Vector& scale, int family, Corrector corrector, Orders orders, double tolerance)
      : problem_(problem), f_(problem), stiff_(f_.system()), x_(makeVector(f_.start(), sun_.context)), absolute_(makeVector(tolerance * scale, sun_.context)),
        memory_(CVodeCreate(family, sun_.context)) {
    CVodeInit(memory_, rightHandSide, 0.0, x_.get());
    CVodeSetErrHandlerFn(memory_, silent, nullptr);
    CVodeSetUserData(memory_, this);
    CVodeSVtolerances(memory_, tolerance, absolute_.get());
    CVodeSetMaxNumSteps(memory_, kMaxSteps);
    if (orders == Orders::kUpToTwo) CVodeSetMaxOrd(memory_, 2);
    if (orders == Orders::kDetectLimit) CVodeSetStabLimDet(memory_, SUNTRUE);
    switch (corrector) {
      case Corrector::kDense: newton_.setDense(memory_, x_.get(), sun_.context, CVodeSetLinearSolver); break;
      case Corrector::kStructured: newton_.setStructured(memory_, stiff_, CVodeGetCurrentGamma, sun_.context, CVodeSetLinearSolver); break;
      case Corrector::kFixedPoint:
        fixed_point_ = SUNNonlinSol_FixedPoint(x_.get(), 0, sun_.context);
        CVodeSetNonlinearSolver(memory_, fixed_point_);
        break;
    }
    states_.resize(f_.size(), problem.instants);
  }

  ~Cvode() override {
    CVodeFree(&memory_);
    if (fixed_point_) SUNNonlinSolFree(fixed_point_);
  }

  bool run() override {
    f_.restart();
    viewOf(x_.get()) = f_.start();
    if (CVodeReInit(memory_, 0.0, x_.get()) != CV_SUCCESS) return false;
    for (Index k = 0; k < problem_.instants; ++k) {
      realtype t = 0.0;
      if (CVode(memory_, static_cast<double>(k + 1) * problem_.spacing(), x_.get(), &t, CV_NORMAL) < 0) return false;
      states_.col(k) = viewOf(x_.get());
    }
    CVodeGetNumSteps(memory_, &steps_);
    evaluations_ = f_.evaluations;
    return true;
  }

 private:
  static int rightHandSide(realtype t, N_Vector x, N_Vector xdot, void* self) { return static_cast<Cvode*>(self)->f_.complete(t, data(x), data(xdot)) ? 0 : 1; }

  Problem problem_;
  RightHandSide f_;
  StiffSolver stiff_;
  SundialsContext sun_;
  NVector x_, absolute_;
  void* memory_;
  NewtonSolver newton_;
  SUNNonlinearSolver fixed_point_ = nullptr;
};

}  // namespace

std::vector<Family> cvodePeers(const Problem& problem, const Vector& scale, bool quick) {
  std::vector<Family> families;
  const auto add = [&](const std::string& method, int family, const std::string& setting, Corrector corrector, Orders orders = Orders::kAll) {
    families.push_back({method, setting, tolerances(quick),
                        [=](double tolerance) { return std::make_unique<Cvode>(problem, scale, family, corrector, orders, tolerance); }});
  };
  add("CVODE BDF", CV_BDF, "structure of S", Corrector::kStructured);
  add("CVODE BDF", CV_BDF, "structure of S, order up to 2", Corrector::kStructured, Orders::kUpToTwo);
  add("CVODE BDF", CV_BDF, "dense Jacobian", Corrector::kDense);
  add("CVODE Adams", CV_ADAMS, "fixed point", Corrector::kFixedPoint);
  add("CVODE Adams", CV_ADAMS, "structure of S", Corrector::kStructured);
  if (quick) return families;
  add("CVODE BDF", CV_BDF, "structure of S, stability limit detection", Corrector::kStructured, Orders::kDetectLimit);
  add("CVODE BDF", CV_BDF, "dense Jacobian, order up to 2", Corrector::kDense, Orders::kUpToTwo);
  return families;
}

}  // namespace heerk_rotor::work_precision
