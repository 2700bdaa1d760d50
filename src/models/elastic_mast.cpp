#include "heerk_rotor/models/elastic_mast.hpp"

#include <cmath>
#include <stdexcept>

#include "heerk_rotor/models/fe_rotor.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {
namespace {
enum State_ { kTwist, kTwistRate };
}

std::vector<State> ElasticMast::states() const {
  return {{"twist", "rad", "hub angle minus drive angle"}, {"twist_rate", "rad/s", "rate of the twist"}};
}

std::vector<InputPort> ElasticMast::inputs() const { return mastInputs(hub_, true); }
std::vector<OutputPort> ElasticMast::outputs() const { return mastOutputs(hub_, true, p_.rotor_speed); }

StiffPart ElasticMast::stiffPart() const {
  ModalStiff part;
  part.omega = Vector::Constant(1, std::sqrt((p_.stiffness + load_.stiffness) / load_.inertia));
  part.damping = Vector::Constant(1, (p_.damping + load_.damping) / load_.inertia);
  return part;
}

double ElasticMast::hubAcceleration(const In& x, const In& u) const noexcept {
  const double in_space = (u[kReaction] - p_.stiffness * x[kTwist] - p_.damping * x[kTwistRate]) * per_inertia_;
  return hub_ == MastHub::kOwn ? in_space - u[kMountAcceleration + kYaw] : in_space;
}

void ElasticMast::evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept {
  switch (port) {
    case kHubMotion: y << p_.rotor_speed * t + u[kDriveAngle] + x[kTwist], p_.rotor_speed + u[kDriveRate] + x[kTwistRate], x[kTwist], x[kTwistRate]; break;
    case kHubAcceleration: y << hubAcceleration(x, u), u[kDriveAcceleration]; break;
    case kTwistOut: y[0] = x[kTwist]; break;
    case kAzimuth: y[0] = p_.rotor_speed * t + u[kDriveAngle] + x[kTwist]; break;
    case kSpeed: y[0] = p_.rotor_speed + u[kDriveRate] + x[kTwistRate]; break;
    case kTorque: y[0] = p_.stiffness * x[kTwist] + p_.damping * x[kTwistRate]; break;
    case kGyroscopicMoment: gyroscopicMoment(hubAngularMomentum(load_.inertia, p_.rotor_speed + u[kDriveRate] + x[kTwistRate], u), u, y); break;
    case kHubAngularMomentum: y[0] = hubAngularMomentum(load_.inertia, p_.rotor_speed + u[kDriveRate] + x[kTwistRate], u); break;
  }
}

bool ElasticMast::outputJacobian(Index port, double, const In&, const In&, Eigen::Map<Matrix> jacobian) noexcept {
  if (port != kHubAcceleration) return false;
  jacobian(0, kReaction) = 1.0 / load_.inertia;
  jacobian(1, kDriveAcceleration) = 1.0;
  if (hub_ == MastHub::kOwn) jacobian(0, kMountAcceleration + kYaw) = -1.0;
  return true;
}

void ElasticMast::evalDerivatives(double, const In& x, const In& u, Out xdot) noexcept {
  xdot[kTwist] = x[kTwistRate];
  xdot[kTwistRate] = hubAcceleration(x, u) - u[kDriveAcceleration];
}

void ElasticMast::evalRemainder(double, const In& x, const In& u, Out remainder) noexcept {
  remainder[kTwist] = 0.0;
  remainder[kTwistRate] = (u[kReaction] + load_.stiffness * x[kTwist] + load_.damping * x[kTwistRate]) * per_inertia_ - u[kDriveAcceleration];
  if (hub_ == MastHub::kOwn) remainder[kTwistRate] -= u[kMountAcceleration + kYaw];
}

namespace {

/// A spring-mounted hub needs inertia of its own: without hinge offset or blade inertia, common lag motion balances the hub of a lag
/// rotor completely (kappa is infinite) and the coupled system is not index 1. Long before that its equations lose all digits, because
/// the hub acceleration is a difference that is kappa times smaller than its parts.
bool checkMastInertia(Section& section, double kappa) {
  constexpr double kLargestKappa = 1e8;  // leaves half of the digits
  if (kappa <= kLargestKappa) return true;
  section.problem("type", "rigid_mast, because with so small a hinge_offset or blade_inertia of the rotor the hub has no inertia against "
                          "common lag motion, and an elastic mast makes the system not index 1");
  return false;
}

/// The slow modes of elastic blades as part of what the twist feels at nominal speed.
void addElasticBlades(MastLoad& load, const BuildContext& context) {
  const double frequency = twistFrequency(context);
  if (frequency == 0.0) return;
  Problems reported_by_the_rotor_itself;
  Section rotor(context.configuration, "subsystems." + context.onlySubsystemOfType("fe_rotor"), reported_by_the_rotor_itself);
  rotor.word("type", "");
  rotor.text("initial");
  FeRotorParameters parameters = readFeRotorParameters(rotor, context.simulation.rotor_speed);
  if (!reported_by_the_rotor_itself.empty()) return;
  parameters.absolute_below = frequency;
  try {
    const TwistLoad blades = twistLoad(parameters);
    load.stiffness += blades.stiffness;
    load.damping += blades.damping;
  } catch (const std::exception&) {  // no modes, as the rotor itself reports
  }
}

}  // namespace

Made makeElasticMast(Section& section, const BuildContext& context) {
  ElasticMast::Parameters p;
  p.stiffness = section.number("stiffness", p.stiffness, "N m/rad", positive());
  p.damping = section.number("damping", p.damping, "N m s/rad", nonNegative());
  p.rotor_speed = context.simulation.rotor_speed;
  HubOnMast hub = readHubOnMast(section, context);
  section.finish();
  if (hub.kind == MastHub::kOwn) addElasticBlades(hub.load, context);
  if (!checkMastInertia(section, hub.kappa)) return nullptr;
  return std::make_unique<ElasticMast>(p, hub.load, hub.kind);
}

}  // namespace heerk_rotor
