#pragma once
#include <memory>
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"

namespace heerk_rotor {

/// The right-hand side of the coupled system as an integration method sees it: with the algebraic part solved at every instant asked for.
class StageEvaluator {
 public:
  virtual ~StageEvaluator() = default;
  /// At (t_n, x_n), where the outputs are known already: f = f(t_n, x_n) when `complete`, otherwise the remainder f - S x. Size of the state.
  virtual void atStart(bool complete, double* f) noexcept = 0;
  /// The same at any (t, x). False: x is not finite or the algebraic part has no solution there; the step has failed and the cause is on record.
  virtual bool at(double t, const Vector& x, bool complete, double* f) noexcept = 0;

  /// The remainders in the z and r of narrow forms (CoupledSystem::stageSize()), at (t_n, x_n) and elsewhere. False: not possible there; at() then says
  /// whether anything is wrong.
  virtual bool atStartNarrow(const Vector& z, double* r) noexcept = 0;
  virtual bool atNarrow(double t, const Vector& z, double* r) noexcept = 0;
};

/// An integration method for x' = S x + f~(t, x), made for one system and one step size. One instance per simulation; advance() allocates and
/// throws nothing.
class StepMethod {
 public:
  enum class Outcome {
    kDone,
    kStageFailed,   // the evaluator knows why
    kNotConverged   // the equations of an implicit method
  };

  virtual ~StepMethod() = default;
  virtual std::string name() const = 0;
  virtual int order() const = 0;
  /// Evaluations of f per step; of an implicit method the least.
  virtual int evaluations() const = 0;
  /// Whether stiffness in S costs neither stability nor order.
  virtual bool exponential() const = 0;

  /// next = the solution at t + h, from x at t.
  virtual Outcome advance(StageEvaluator& evaluate, double t, const Vector& x, Vector& next) noexcept = 0;

  /// What a step leaves for the next one to save work with: decides the last bits of the next step and belongs into a checkpoint.
  virtual std::vector<double> memory() const { return {}; }
  /// Takes back what memory() gave; an empty one means: begin anew. Throws std::invalid_argument when it is of another size.
  virtual void restoreMemory(const std::vector<double>& memory);
};

/// The method of that name for this system and step h [s]. `tolerance` is that of implicit equations: the last correction of the state over its size.
/// Throws std::invalid_argument that lists the known names, or says what of the system the method cannot take.
std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, const CoupledSystem& system, double h, double tolerance);

/// All known names: the tableaus, then Newmark, precise_1 and precise_2.
std::vector<std::string> stepMethodNames();

/// Order of a method by name; throws as makeStepMethod.
int orderOfStepMethod(const std::string& name);

}  // namespace heerk_rotor
