#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/stiff_part.hpp"
#include "heerk_rotor/core/types.hpp"

namespace heerk_rotor {

/// What an input port means when nothing is connected to it.
enum class Unconnected {
  kError,    // the model cannot work without it
  kDefault,  // it takes its default value
  kCommand   // it becomes part of the command vector w, set from outside at every step (default until then)
};

/// A named group of inputs. An input is the sum of all outputs connected to it.
struct InputPort {
  std::string name;
  Index size = 1;
  std::string unit;
  std::string meaning;                          // one sentence: what, frame, sign
  Unconnected unconnected = Unconnected::kError;
  std::vector<double> default_value = {};       // (size), empty = zeros
  std::vector<std::string> entries = {};        // names of the entries; empty = <name>_1, <name>_2, ...
  std::vector<double> low = {}, high = {};      // (size) range of a command, beyond which the model clamps; empty = unlimited
  bool only_for_outputs = false;                // f does not read it: what feeds it need not be known within a step
};

/// A named group of outputs. `feedthrough` names the input ports whose present value reaches this port at once.
struct OutputPort {
  std::string name;
  Index size = 1;
  std::string unit;
  std::string meaning;                          // one sentence: what, frame, sign
  std::vector<std::string> feedthrough = {};
  double nominal = 1.0;                         // typical magnitude (> 0): scale of the algebraic residual
  std::vector<std::string> entries = {};        // names of the entries; empty = <name>, or <name>_1, <name>_2, ...
  bool published = false;                       // recorded by default, without being asked for
  std::vector<std::string> entry_units = {};    // units of the entries when they differ; `unit` is then only compared
};

struct State {
  std::string name;
  std::string unit;
  std::string meaning;
  double initial = 0.0;
  std::string initial_key = {};  // what the user calls its initial value; empty = name

  const std::string& initialKey() const { return initial_key.empty() ? name : initial_key; }
};

/// A remainder that reads and moves only a few combinations of many states: f~(t, x, u) = B r(t, z, u) with z = C x.
struct NarrowForm {
  Matrix C;  // (number of z x n)
  Matrix B;  // (n x number of r)
};

/// Where an output port's values go.
struct PortValue {
  Index port;
  double* y;
  Index size;
};

/// One subsystem of the coupled index-1 DAE in state-space form (HEERK paper, eq. 1):
///   x' = f(t, x, u),  y = g(t, x, u).
/// u holds all input ports one after the other in the order of inputs(); evaluating an output port may read only the
/// inputs it declares as feedthrough. Evaluation allocates nothing, throws nothing and remembers nothing: a model that
/// remembers does so in its state. One instance per thread.
class SubsystemModel {
 public:
  virtual ~SubsystemModel() = default;

  virtual std::vector<State> states() const = 0;
  virtual std::vector<InputPort> inputs() const = 0;
  virtual std::vector<OutputPort> outputs() const = 0;
  virtual StiffPart stiffPart() const;  // default: zero

  /// y = the output port's values.
  virtual void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept = 0;

  /// Several output ports at one (t, x, u): for a model whose ports share work. Default: one after the other.
  virtual void evalOutputs(const PortValue* values, Index count, double t, const In& x, const In& u) noexcept;

  /// Says that from now on, until the contrary is said, all evaluations are at one x: a model that keeps what follows from the state alone need look
  /// only once whether it has changed. Returns whether the model makes use of it.
  virtual bool holdState(bool held) noexcept;

  /// The complete right-hand side f(t, x, u).
  virtual void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept = 0;

  /// The remainder f(t, x, u) - S x, directly: only for models in which large terms would cancel. Must agree with
  /// evalDerivatives to round-off; providesRemainder() then returns true.
  virtual bool providesRemainder() const { return false; }
  virtual void evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept;

  /// For a model with a remainder of narrow form: an exponential method then carries z instead of x through the stages of a step, as long as all
  /// ports that these need can be evaluated from z, too. Constant; nullptr: no such form.
  virtual const NarrowForm* narrowForm() const { return nullptr; }
  /// Whether evalNarrowOutput() knows this port.
  virtual bool narrowOutput(Index port) const;
  virtual void evalNarrowOutput(Index port, double t, const In& z, const In& u, Out y) noexcept;
  /// r(t, z, u). False: not with these inputs; the step is then taken with x.
  virtual bool evalNarrowRemainder(double t, const In& z, const In& u, Out r) noexcept;

  /// jacobian(i, j) = d y_i / d u_j (port size x input size, column-major) when the model knows it; false: differenced.
  virtual bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept;

  /// Initial values that models of the same role have as states and this one has not: accepted without effect, so that
  /// one line of the configuration swaps the models.
  virtual std::vector<std::string> ignoredInitialValues() const { return {}; }

  /// Called once at t0 with the inputs that other models' initial states already determine (no feedthrough); lets a
  /// model derive its initial state from what the user gave (x holds the given initial values).
  virtual void completeInitialState(const In& u, Out x) const;
};

}  // namespace heerk_rotor
