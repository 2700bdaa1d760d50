#pragma once
#include <functional>
#include <utility>

#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// A subsystem put together from lambdas, for tests of the coupling itself.
class FunctionModel : public SubsystemModel {
 public:
  using Output = std::function<void(double t, const In& x, const In& u, Out y)>;

  FunctionModel& state(const std::string& name, double initial) {
    states_.push_back({name, "-", "", initial});
    return *this;
  }
  FunctionModel& input(const std::string& name, Index size = 1, const std::string& unit = "-", Unconnected unconnected = Unconnected::kError) {
    inputs_.push_back({name, size, unit, "", unconnected});
    return *this;
  }
  FunctionModel& output(const std::string& name, Index size, std::vector<std::string> feedthrough, Output function, const std::string& unit = "-") {
    outputs_.push_back({name, size, unit, "", std::move(feedthrough)});
    functions_.push_back(std::move(function));
    return *this;
  }
  FunctionModel& derivatives(Output function) {
    derivatives_ = std::move(function);
    return *this;
  }
  FunctionModel& stiff(StiffPart part) {
    stiff_ = std::move(part);
    return *this;
  }
  std::unique_ptr<SubsystemModel> make() const { return std::make_unique<FunctionModel>(*this); }

  std::vector<State> states() const override { return states_; }
  std::vector<InputPort> inputs() const override { return inputs_; }
  std::vector<OutputPort> outputs() const override { return outputs_; }
  StiffPart stiffPart() const override { return stiffSize(stiff_) > 0 ? stiff_ : SubsystemModel::stiffPart(); }
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override { functions_[static_cast<std::size_t>(port)](t, x, u, y); }
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override { derivatives_(t, x, u, xdot); }

 private:
  std::vector<State> states_;
  std::vector<InputPort> inputs_;
  std::vector<OutputPort> outputs_;
  std::vector<Output> functions_;
  Output derivatives_;
  StiffPart stiff_ = ZeroStiff{0};
};

}  // namespace heerk_rotor
