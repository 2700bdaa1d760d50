// SUNDIALS ARKODE: explicit, diagonally implicit and additive (IMEX) Runge-Kutta methods with error control.
#include <arkode/arkode_arkstep.h>

#include "integration.hpp"
#include "right_hand_side.hpp"
#include "sundials_support.hpp"

namespace heerk_rotor::work_precision {
namespace {

enum class Split { kExplicit, kImplicit, kAdditive };

/// Names of a pair of tables; "" means none.
struct Tables {
  std::string implicit_name, explicit_name;
};

class Arkode final : public Integration {
 public:
  Arkode(const Problem& problem, const Vector& scale, Split split, bool dense, const Tables& tables, double tolerance, bool stop)
      : problem_(problem), f_(problem), stiff_(f_.system()), stop_(stop), split_(split), x_(makeVector(f_.start(), sun_.context)),
        absolute_(makeVector(tolerance * scale, sun_.context)) {
    memory_ = create(x_.get());
    ARKStepSetErrHandlerFn(memory_, silent, nullptr);
    ARKStepSetUserData(memory_, this);
    ARKStepSVtolerances(memory_, tolerance, absolute_.get());
    ARKStepSetMaxNumSteps(memory_, kMaxSteps);
    const auto orNone = [](const std::string& name, const char* none) { return name.empty() ? none : name.c_str(); };
    ARKStepSetTableName(memory_, orNone(tables.implicit_name, "ARKODE_DIRK_NONE"), orNone(tables.explicit_name, "ARKODE_ERK_NONE"));
    if (split != Split::kExplicit) {
      if (dense) newton_.setDense(memory_, x_.get(), sun_.context, ARKStepSetLinearSolver);
      else newton_.setStructured(memory_, stiff_, ARKStepGetCurrentGamma, sun_.context, ARKStepSetLinearSolver);
      ARKStepSetDeduceImplicitRhs(memory_, SUNTRUE);
    }
    if (split == Split::kAdditive) ARKStepSetLinear(memory_, 0);
    states_.resize(f_.size(), problem.instants);
  }

  ~Arkode() override { ARKStepFree(&memory_); }

  bool run() override {
    f_.restart();
    viewOf(x_.get()) = f_.start();
    if (ARKStepReInit(memory_, split_ == Split::kImplicit ? nullptr : explicitFunction(), implicitFunction(), 0.0, x_.get()) != ARK_SUCCESS) return false;
    for (Index k = 0; k < problem_.instants; ++k) {
      const double end = static_cast<double>(k + 1) * problem_.spacing();
      if (stop_) ARKStepSetStopTime(memory_, end);
      realtype t = 0.0;
      if (ARKStepEvolve(memory_, end, x_.get(), &t, ARK_NORMAL) < 0) return false;
      states_.col(k) = viewOf(x_.get());
    }
    ARKStepGetNumSteps(memory_, &steps_);
    evaluations_ = f_.evaluations;
    return true;
  }

 private:
  void* create(N_Vector x) { return ARKStepCreate(explicitFunction(), implicitFunction(), 0.0, x, sun_.context); }
  ARKRhsFn explicitFunction() const { return split_ == Split::kExplicit ? complete : split_ == Split::kAdditive ? remainder : nullptr; }
  ARKRhsFn implicitFunction() const { return split_ == Split::kImplicit ? complete : split_ == Split::kAdditive ? linear : nullptr; }

  static int complete(realtype t, N_Vector x, N_Vector xdot, void* self) { return static_cast<Arkode*>(self)->f_.complete(t, data(x), data(xdot)) ? 0 : 1; }
  static int remainder(realtype t, N_Vector x, N_Vector xdot, void* self) { return static_cast<Arkode*>(self)->f_.remainder(t, data(x), data(xdot)) ? 0 : 1; }
  static int linear(realtype, N_Vector x, N_Vector xdot, void* self) {
    static_cast<Arkode*>(self)->stiff_.multiply(data(x), data(xdot));
    return 0;
  }

  Problem problem_;
  RightHandSide f_;
  StiffSolver stiff_;
  bool stop_;
  Split split_;
  SundialsContext sun_;
  NVector x_, absolute_;
  void* memory_;
  NewtonSolver newton_;
};

}  // namespace

std::vector<Family> arkodePeers(const Problem& problem, const Vector& scale, bool quick) {
  std::vector<Family> families;
  const auto add = [&](const std::string& method, Split split, bool dense, const std::string& setting, const Tables& tables) {
    families.push_back({method, setting, tolerances(quick),
                        [=](double tolerance) { return std::make_unique<Arkode>(problem, scale, split, dense, tables, tolerance, false); }});
  };
  const auto additive = [&](const std::string& order, const std::string& name, const std::string& stages) {
    const Tables tables{"ARKODE_" + name + "_DIRK_" + stages, "ARKODE_" + name + "_ERK_" + stages};
    add("ARKODE IMEX", Split::kAdditive, false, "order " + order + ", S implicit by its structure", tables);
  };
  add("ARKODE ERK", Split::kExplicit, false, "order 5", {"", "ARKODE_DORMAND_PRINCE_7_4_5"});
  additive("4", "ARK437L2SA", "7_3_4");
  additive("5", "ARK548L2SAb", "8_4_5");
  add("ARKODE DIRK", Split::kImplicit, false, "order 4, structure of S", {"ARKODE_ESDIRK436L2SA_6_3_4", ""});
  if (quick) return families;
  add("ARKODE ERK", Split::kExplicit, false, "order 4", {"", "ARKODE_ZONNEVELD_5_3_4"});
  add("ARKODE ERK", Split::kExplicit, false, "order 8", {"", "ARKODE_FEHLBERG_13_7_8"});
  additive("3", "ARK324L2SA", "4_2_3");
  add("ARKODE DIRK", Split::kImplicit, false, "order 5, structure of S", {"ARKODE_ESDIRK547L2SA_7_4_5", ""});
  add("ARKODE DIRK", Split::kImplicit, true, "order 4, dense Jacobian", {"ARKODE_ESDIRK436L2SA_6_3_4", ""});
  return families;
}

std::unique_ptr<Integration> tightExplicit(const Problem& problem, const Vector& scale) {
  Problem tight = problem;
  tight.newton_tolerance = 1e-14;
  return std::make_unique<Arkode>(tight, scale, Split::kExplicit, false, Tables{"", "ARKODE_FEHLBERG_13_7_8"}, 1e-13, true);
}

}  // namespace heerk_rotor::work_precision
