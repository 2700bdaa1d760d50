#pragma once
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// A coupling that cannot be made; the message names both ports, sizes, units and the nearest existing name.
struct CouplingError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Builder of the coupled system: subsystems by name, connections by port.
///   graph.add("mast", ...); graph.connect("mast.hub_motion", "rotor.hub_motion"); CoupledSystem system = std::move(graph).build();
class CouplingGraph {
 public:
  /// `initial` overrides the states' declared initial values, by State::initialKey().
  /// Throws CouplingError for a name that is taken or is no identifier, an unknown initial key, or inconsistent ports.
  void add(const std::string& name, std::unique_ptr<SubsystemModel> model,
           const std::map<std::string, double>& initial = {});

  /// Connects an output port to an input port; several outputs on one input are summed.
  /// Throws CouplingError when a port does not exist, sizes or units differ, or the pair is connected already.
  void connect(const std::string& output, const std::string& input);

  /// Names of input ports that nothing drives and that have no default.
  std::vector<std::string> unconnectedInputs() const;

  /// Throws CouplingError when inputs are unconnected.
  CoupledSystem build() &&;

 private:
  struct Entry {
    std::string name;
    std::unique_ptr<SubsystemModel> model;
    std::vector<State> states;
    std::vector<InputPort> inputs;
    std::vector<OutputPort> outputs;
  };
  struct Connection {
    Index output_model, output_port, input_model, input_port;
  };
  struct PortPlace {
    Index model, port;
  };
  PortPlace find(const std::string& path, bool output) const;
  bool driven(Index model, Index port) const;

  std::vector<Entry> entries_;
  std::vector<Connection> connections_;
};

}  // namespace heerk_rotor
