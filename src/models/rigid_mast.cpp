#include "heerk_rotor/models/rigid_mast.hpp"

#include "model_factories.hpp"

namespace heerk_rotor {

std::vector<InputPort> RigidMast::inputs() const { return mastInputs(hub_, false); }
std::vector<OutputPort> RigidMast::outputs() const { return mastOutputs(hub_, false, rotor_speed_); }

void RigidMast::evalOutput(Index port, double t, const In&, const In& u, Out y) noexcept {
  switch (port) {
    case kHubMotion: y << rotor_speed_ * t + u[kDriveAngle], rotor_speed_ + u[kDriveRate], 0.0, 0.0; break;
    case kHubAcceleration: y << u[kDriveAcceleration], u[kDriveAcceleration]; break;
    case kTwistOut: y[0] = 0.0; break;
    case kAzimuth: y[0] = rotor_speed_ * t + u[kDriveAngle]; break;
    case kSpeed: y[0] = rotor_speed_ + u[kDriveRate]; break;
    case kTorque:
      y[0] = u[kReaction] - load_.inertia * u[kDriveAcceleration];
      if (hub_ == MastHub::kOwn) y[0] -= load_.inertia * u[kMountAcceleration + kYaw];
      break;
    case kGyroscopicMoment: gyroscopicMoment(hubAngularMomentum(load_.inertia, rotor_speed_ + u[kDriveRate], u), u, y); break;
    case kHubAngularMomentum: y[0] = hubAngularMomentum(load_.inertia, rotor_speed_ + u[kDriveRate], u); break;
  }
}

bool RigidMast::outputJacobian(Index port, double, const In&, const In&, Eigen::Map<Matrix> jacobian) noexcept {
  // Only a hub of its own is in a loop (reaction, torque, yaw acceleration of the mount).
  if (port != kTorque || hub_ != MastHub::kOwn) return false;
  jacobian(0, kReaction) = 1.0;
  jacobian(0, kDriveAcceleration) = jacobian(0, kMountAcceleration + kYaw) = -load_.inertia;
  return true;
}

Made makeRigidMast(Section& section, const BuildContext& context) {
  // Keys of elastic_mast, without effect here: one line, `type`, swaps the masts.
  section.number("stiffness", 0.0, "N m/rad", positive());
  section.number("damping", 0.0, "N m s/rad", nonNegative());
  const HubOnMast hub = readHubOnMast(section, context);
  section.finish();
  return std::make_unique<RigidMast>(context.simulation.rotor_speed, hub.load, hub.kind);
}

}  // namespace heerk_rotor
