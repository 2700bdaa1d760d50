#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// One scalar that can be recorded: a state or an output entry, "subsystem.name".
struct Signal {
  enum class Kind { kState, kOutput };
  std::string name;
  std::string unit;
  std::string meaning;
  Kind kind;
  Index index;        // into the global x or y
  bool published;
};

/// The index-1 DAE made of all subsystems, flattened: global vectors x (states), u (inputs), y (outputs), w (commands),
/// and the primitives by which solver and integrator evaluate it. Built by CouplingGraph; sizes never change.
class CoupledSystem {
 public:
  struct Subsystem {
    std::string name;
    std::unique_ptr<SubsystemModel> model;
    StiffPart stiff;
    bool provides_remainder;
    Index x_begin, x_size, u_begin, u_size, y_begin, y_size;
    // What the stages of a step may carry instead of x and the remainder: z = C x and r of the narrow form, or x and the remainder themselves.
    const NarrowForm* narrow = nullptr;
    Index z_begin, z_size, r_begin, r_size;
  };

  /// An output port within the global y.
  struct Output {
    std::string name;                    // "subsystem.port"
    Index subsystem, port;               // owner, and number within it
    Index begin, size;                   // entries of y
    double nominal;
    std::vector<Index> feedthrough;      // global input ports it depends on at once
  };

  /// An input port within the global u.
  struct Input {
    std::string name;
    Index subsystem;
    Index begin, size;                   // entries of u
    std::vector<Index> sources;          // global output ports that are summed
    std::vector<Index> source_begin;     // their first entries of y
    Index command = -1;                  // first entry of w, when it is a command
    Vector default_value;                // (size) used when there are no sources and no command
    bool only_for_outputs = false;
  };

  Index stateSize() const { return x_size_; }
  Index inputSize() const { return u_size_; }
  Index outputSize() const { return y_size_; }
  Index commandSize() const { return default_command_.size(); }

  /// Of the stages' z and r, see chooseNarrowForms(); without one they are x and the remainder.
  Index stageSize() const { return z_size_; }
  Index stageRemainderSize() const { return r_size_; }
  bool hasNarrowForms() const { return has_narrow_forms_; }

  const std::vector<Subsystem>& subsystems() const { return subsystems_; }
  const std::vector<Output>& outputs() const { return outputs_; }
  const std::vector<Input>& inputs() const { return inputs_; }

  /// All states and output entries by name. A state that a model also offers as output entry appears once, as output.
  /// signal() throws std::out_of_range with the nearest name; findSignal() returns nullptr.
  const std::vector<Signal>& signals() const { return signals_; }
  const Signal& signal(const std::string& name) const;
  const Signal* findSignal(const std::string& name) const;

  /// Names of the entries of w ("swashplate.collective", ...), their units, and their defaults.
  const std::vector<std::string>& commandNames() const { return command_names_; }
  const Vector& defaultCommand() const { return default_command_; }
  /// Range of each command, infinite where the model states none; models clamp beyond it.
  const Vector& commandLow() const { return command_low_; }
  const Vector& commandHigh() const { return command_high_; }

  /// x at t0: declared initial values, then each model's completeInitialState in order, then what setStart() says.
  Vector initialState() const;

  /// Names "subsystem.state" and units of all entries of x.
  std::vector<std::string> stateNames() const;
  std::vector<std::string> stateUnits() const;

  /// Start values found elsewhere (a trimmed state): entries of x that hold as they are, whatever initial values were
  /// declared, and the command (commandSize()) that is the default from now on.
  void setStart(std::vector<std::pair<Index, double>> states, const Vector& command);

  /// Puts another model in the place of a subsystem's, with the same states and ports: one that forwards to it and measures, say. Returns the old one.
  std::unique_ptr<SubsystemModel> exchangeModel(Index subsystem, std::unique_ptr<SubsystemModel> model);

  /// Sums the sources of one input port into u. Returns whether any entry changed (bitwise).
  bool gather(Index input, const Vector& y, const Vector& w, Vector& u) const noexcept;

  /// The same without asking for changes.
  void fetch(Index input, const Vector& y, const Vector& w, Vector& u) const noexcept;

  /// What evaluating an output port takes, in one place.
  struct OutputCall {
    SubsystemModel* model;
    Index port;                          // within the model
    bool narrow;                         // the state is given as z of the narrow form
    Index x_begin, x_size, u_begin, u_size, size;

    /// x (or z), u: global; result: the port's entries only.
    void operator()(double t, const double* x, const double* u, double* result) const noexcept {
      const In xs(x + x_begin, x_size), us(u + u_begin, u_size);
      if (narrow) model->evalNarrowOutput(port, t, xs, us, Out(result, size));
      else model->evalOutput(port, t, xs, us, Out(result, size));
    }
  };
  /// in_stage: with z (stageSize()) instead of x, see chooseNarrowForms().
  const OutputCall& outputCall(Index output, bool in_stage) const { return (in_stage ? stage_calls_ : calls_)[static_cast<std::size_t>(output)]; }

  /// Evaluates one output port into `result` (its entries only).
  void evalOutput(Index output, double t, const Vector& x, const Vector& u, double* result) noexcept { calls_[static_cast<std::size_t>(output)](t, x.data(), u.data(), result); }

  /// Evaluates several output ports of one subsystem, at most kTogether; values of port outputs[k] begin at results[k]. in_stage: as for outputCall().
  static constexpr Index kTogether = 8;
  void evalTogether(const Index* outputs, Index count, bool in_stage, double t, const Vector& x, const Vector& u, double* const* results) noexcept;

  /// remainder = f(t, x, u) - S x of all subsystems, or the complete f when `complete` is set.
  void evalRemainder(double t, const Vector& x, const Vector& u, bool complete, double* remainder) noexcept;

  /// Takes the narrow form of every model all of whose `needed` outputs (one flag per output) can be evaluated from it.
  void chooseNarrowForms(const std::vector<char>& needed);

  /// All remainders in a stage, from z (stageSize()) into r (stageRemainderSize()). False where some model has no narrow form with these inputs.
  bool evalStageRemainder(double t, const Vector& z, const Vector& u, double* r) noexcept;

 private:
  friend class CouplingGraph;

  /// What evaluating the right-hand side of a subsystem with states takes.
  struct RatesCall {
    SubsystemModel* model;
    bool narrow, provides_remainder;
    const StiffPart* stiff;              // nullptr: zero
    Index x_begin, x_size, z_begin, z_size, r_begin, r_size, u_begin, u_size;

    void operator()(double t, const double* x, const double* u, bool complete, double* remainder) const noexcept {
      // Views are made where they are handed over: one that is copied waits until its parts have left the store buffer.
      const In xs(x, x_size), us(u + u_begin, u_size);
      if (provides_remainder && !complete) return model->evalRemainder(t, xs, us, Out(remainder, x_size));
      model->evalDerivatives(t, xs, us, Out(remainder, x_size));
      if (stiff && !complete) takeOffStiff(x, remainder);
    }
    void takeOffStiff(const double* x, double* remainder) const noexcept;
  };

  void layOutStages();
  const double* firstSource(const Input& input, const Vector& y, const Vector& w) const noexcept;

  std::vector<Subsystem> subsystems_;
  std::vector<Output> outputs_;
  std::vector<Input> inputs_;
  std::vector<OutputCall> calls_, stage_calls_;  // of outputs_
  std::vector<RatesCall> rates_calls_;
  std::vector<Signal> signals_;
  Vector declared_initial_;
  std::vector<std::pair<Index, double>> start_;
  std::vector<std::string> command_names_;
  Vector default_command_, command_low_, command_high_;
  Index x_size_ = 0, u_size_ = 0, y_size_ = 0, z_size_ = 0, r_size_ = 0;
  bool has_narrow_forms_ = false;
};

}  // namespace heerk_rotor
