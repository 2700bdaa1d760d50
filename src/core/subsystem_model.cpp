#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

StiffPart SubsystemModel::stiffPart() const { return ZeroStiff{static_cast<Index>(states().size())}; }

void SubsystemModel::evalOutputs(const PortValue* values, Index count, double t, const In& x, const In& u) noexcept {
  for (Index k = 0; k < count; ++k) evalOutput(values[k].port, t, x, u, Out(values[k].y, values[k].size));
}

bool SubsystemModel::holdState(bool) noexcept { return false; }

void SubsystemModel::evalRemainder(double t, const In& x, const In& u, Out remainder) noexcept {
  evalDerivatives(t, x, u, remainder);  // right for S = 0; a model with providesRemainder() overrides this
}

bool SubsystemModel::narrowOutput(Index) const { return false; }

void SubsystemModel::evalNarrowOutput(Index, double, const In&, const In&, Out) noexcept {}

bool SubsystemModel::evalNarrowRemainder(double, const In&, const In&, Out) noexcept { return false; }

bool SubsystemModel::outputJacobian(Index, double, const In&, const In&, Eigen::Map<Matrix>) noexcept { return false; }

void SubsystemModel::completeInitialState(const In&, Out) const {}

}  // namespace heerk_rotor
