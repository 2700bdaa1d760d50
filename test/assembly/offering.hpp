#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "heerk_rotor/core/coupling_graph.hpp"

namespace heerk_rotor::test {

/// Offers output ports of given sizes and takes commands; values do not matter, the tests fill y and w themselves.
class Offering : public SubsystemModel {
 public:
  Offering(std::vector<std::pair<std::string, Index>> outputs, std::vector<std::string> commands = {})
      : outputs_(std::move(outputs)), commands_(std::move(commands)) {}
  std::vector<State> states() const override { return {}; }
  std::vector<InputPort> inputs() const override {
    if (commands_.empty()) return {};
    return {{"command", static_cast<Index>(commands_.size()), "rad", "commands", Unconnected::kCommand, {}, commands_}};
  }
  std::vector<OutputPort> outputs() const override {
    std::vector<OutputPort> ports;
    for (const auto& output : outputs_) ports.push_back({output.first, output.second, "-", "offered"});
    return ports;
  }
  void evalOutput(Index, double, const In&, const In&, Out y) noexcept override { y.setZero(); }
  void evalDerivatives(double, const In&, const In&, Out) noexcept override {}

 private:
  std::vector<std::pair<std::string, Index>> outputs_;
  std::vector<std::string> commands_;
};

inline CoupledSystem build(std::vector<std::unique_ptr<SubsystemModel>> models) {
  CouplingGraph graph;
  for (std::size_t i = 0; i < models.size(); ++i) graph.add("part_" + std::to_string(i), std::move(models[i]));
  return std::move(graph).build();
}

template <class... Parts>
CoupledSystem systemOf(Parts... parts) {
  std::vector<std::unique_ptr<SubsystemModel>> models;
  (models.push_back(std::make_unique<Offering>(std::move(parts))), ...);
  return build(std::move(models));
}

}  // namespace heerk_rotor::test
