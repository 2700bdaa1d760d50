#include "heerk_rotor/models/mount.hpp"

#include "heerk_rotor/models/planar_mount.hpp"
#include "heerk_rotor/models/rigid_body_mount.hpp"
#include "model_factories.hpp"

namespace heerk_rotor {

using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

enum Input_ { kRotorForce, kTiltingMoment = 3, kMastTorque = 5, kExternalForce = 6, kExternalMoment = 9, kWind = 12 };  // offsets into u
enum Output_ { kVelocity, kAcceleration, kHubWind, kPositionOut, kOrientationOut, kFuselageVelocity, kRates, kHubForce, kHubMoment,
               kHubPosition, kHubOrientation, kHubGravity, kLinearMomentum, kAngularMomentum, kEnergy, kSpringWrench };

Matrix3d crossMatrix(const Vector3d& r) {
  Matrix3d matrix;
  matrix << 0.0, -r[2], r[1], r[2], 0.0, -r[0], -r[1], r[0], 0.0;
  return matrix;
}

std::vector<std::string> axes(const std::string& prefix) { return {prefix + "_x", prefix + "_y", prefix + "_z"}; }

std::vector<std::string> quaternion(const std::string& prefix) { return {prefix + "_w", prefix + "_x", prefix + "_y", prefix + "_z"}; }

std::vector<std::string> axes(const std::string& first, const std::string& second) {
  std::vector<std::string> names = axes(first);
  for (const std::string& name : axes(second)) names.push_back(name);
  return names;
}

std::vector<std::string> units(const std::string& first, const std::string& second) { return {first, first, first, second, second, second}; }

}  // namespace

Vector3d mirroredPolar(const Vector3d& v) noexcept { return {v[0], -v[1], v[2]}; }
Vector3d mirroredAxial(const Vector3d& v) noexcept { return {-v[0], v[1], -v[2]}; }

Mount::Mount(const MountParameters& parameters)
    : p_(parameters), R_BH_(Eigen::AngleAxisd(parameters.shaft_tilt_forward, Vector3d::UnitY()).toRotationMatrix()) {
  const Vector3d ones = Vector3d::Ones();
  polar_ = p_.clockwise ? mirroredPolar(ones) : ones;
  axial_ = p_.clockwise ? mirroredAxial(ones) : ones;
  load_gain_.setZero();
}

std::vector<InputPort> Mount::inputs() const {
  const std::string mirrored = p_.clockwise ? " of the mirrored rotor" : "";
  return {{"rotor_force", 3, "N", "force of the rotor on the fuselage at the hub centre, in hub_link" + mirrored, Unconnected::kDefault, {}, {"x", "y", "z"}},
          {"tilting_moment", 2, "N m", "moment of the rotor on the fuselage at the hub centre about x and y of hub_link" + mirrored, Unconnected::kDefault, {}, {"x", "y"}},
          {"mast_torque", 1, "N m", "torque of the mast on the fuselage about +z of hub_link" + mirrored, Unconnected::kDefault},
          {"external_wrench", 6, "N, N m", "force at the centre of gravity of the fuselage and moment about it, in base_link axes", Unconnected::kCommand,
           {}, axes("external_force", "external_moment")},
          {"wind", 3, "m/s", "velocity of the air over ground, in odom axes (x forward at zero heading, y left, z up)", Unconnected::kCommand,
           {p_.wind[0], p_.wind[1], p_.wind[2]}, axes("wind")}};
}

std::vector<OutputPort> Mount::outputs() const {
  const std::string frame = p_.clockwise ? "hub_link mirrored at its x-z plane" : "hub_link";
  std::vector<OutputPort> list{
      {"mount_velocity", 6, "m/s, rad/s", "velocity of the hub centre over ground and angular velocity of the mount, in " + frame, {}, 1.0,
       axes("hub_velocity", "hub_rate"), false, units("m/s", "rad/s")},
      {"mount_acceleration", 6, "m/s^2, rad/s^2", "acceleration of the hub centre minus gravity and angular acceleration of the mount, in " + frame, accelerationFeedthrough(), 10.0,
       axes("hub_specific_force", "hub_angular_acceleration"), false, units("m/s^2", "rad/s^2")},
      {"hub_wind", 3, "m/s", "velocity of the air over ground at the hub, in " + frame, {"wind"}, 10.0, axes("hub_wind"), false},
      {"fuselage_position", 3, "m", "base_link (centre of gravity of the fuselage) in odom", {}, 1.0, axes("position"), true},
      {"fuselage_orientation", 4, "-", "unit quaternion w x y z that turns base_link axes into odom axes", {}, 1.0, quaternion("orientation"), true},
      {"fuselage_velocity", 3, "m/s", "velocity of base_link over ground, in base_link axes", {}, 1.0, axes("velocity"), true},
      {"fuselage_rates", 3, "rad/s", "angular velocity of base_link, in base_link axes (roll right, pitch nose down, yaw left positive)", {}, 0.1, axes("rate"), true},
      {"hub_force", 3, "N", "force that the fuselage receives at the hub, in hub_link (x forward, y left, z up)", {"rotor_force"}, 1e4, axes("hub_force"), true},
      {"hub_moment", 3, "N m", "moment that the fuselage receives at the hub, in hub_link", {"tilting_moment", "mast_torque"}, 1e3, axes("hub_moment"), true},
      {"hub_position", 3, "m", "hub centre in odom", {}, 1.0, axes("hub_position"), false},
      {"hub_orientation", 4, "-", "unit quaternion w x y z that turns hub_link axes into odom axes", {}, 1.0, quaternion("hub_orientation"), false},
      {"hub_gravity", 3, "m/s^2", "acceleration of free fall, in " + frame, {}, 10.0, axes("hub_gravity"), false},
      {"fuselage_momentum", 3, "N s", "linear momentum of the fuselage, in odom axes", {}, 1e3, axes("momentum"), false},
      {"fuselage_angular_momentum", 3, "N m s", "angular momentum of the fuselage about the origin of odom, in odom axes", {}, 1e3, axes("angular_momentum"), false},
      {"fuselage_energy", 1, "J", "mechanical energy of the fuselage: kinetic, of the springs, of the weight", {}, 1e3, {}, false}};
  if (hasSprings())
    list.push_back({"spring_wrench", 6, "N, N m", "force of springs and dampers on the fuselage, and moment about the origin of odom, in odom axes", {}, 1e4,
                    axes("spring_force", "spring_moment"), false, units("N", "N m")});
  return list;
}

std::vector<std::string> Mount::ignoredInitialValues() const {
  std::vector<std::string> names{"position_x_rate", "position_y_rate"};
  for (const auto& group : {axes("position"), quaternion("orientation"), axes("velocity"), axes("rate")}) names.insert(names.end(), group.begin(), group.end());
  return names;
}

Vector3d Mount::rotorForce(const In& u) const noexcept { return R_BH_ * polar_.cwiseProduct(u.segment<3>(kRotorForce)); }

Vector3d Mount::rotorMoment(const In& u) const noexcept {
  // tilting_moment and mast_torque are neighbours: together the moment about x, y, z.
  return R_BH_ * axial_.cwiseProduct(u.segment<3>(kTiltingMoment)) + p_.hub_offset.cross(rotorForce(u));
}

Vector3d Mount::externalForce(const In& u) noexcept { return u.segment<3>(kExternalForce); }
Vector3d Mount::externalMoment(const In& u) noexcept { return u.segment<3>(kExternalMoment); }

void Mount::setLoadGain(const Matrix3d& inverse_mass_B, const Matrix3d& inverse_inertia_B) {
  // From loads (in H', and the external ones in B) to force and moment at the centre of gravity in B ...
  const Matrix3d lever = crossMatrix(p_.hub_offset);
  const Matrix3d force = R_BH_ * polar_.asDiagonal(), moment = R_BH_ * axial_.asDiagonal();
  Eigen::Matrix<double, 6, kLoads> load = Eigen::Matrix<double, 6, kLoads>::Zero();
  load.block<3, 3>(0, kRotorForce) = force;
  load.block<3, 3>(3, kRotorForce) = lever * force;
  load.block<3, 3>(3, kTiltingMoment) = moment;
  load.block<6, 6>(0, kExternalForce).setIdentity();
  // ... to the accelerations there, then at the hub (a + omega' x r), and into H'.
  Eigen::Matrix<double, 6, kLoads> acceleration;
  acceleration.topRows<3>() = inverse_mass_B * load.topRows<3>();
  acceleration.bottomRows<3>() = inverse_inertia_B * load.bottomRows<3>();
  load_gain_.topRows<3>() = force.transpose() * (acceleration.topRows<3>() - lever * acceleration.bottomRows<3>());
  load_gain_.bottomRows<3>() = moment.transpose() * acceleration.bottomRows<3>();
}

void Mount::evalOutput(Index port, double, const In& x, const In& u, Out y) noexcept {
  const FuselageMotion m = motion(x);
  const Vector3d& r = p_.hub_offset;
  switch (port) {
    case kVelocity:
      y.head<3>() = polar_.cwiseProduct(R_BH_.transpose() * (m.velocity_B + m.rates_B.cross(r)));
      y.tail<3>() = axial_.cwiseProduct(R_BH_.transpose() * m.rates_B);
      break;
    case kAcceleration: {
      const Acceleration a = acceleration(m, u);
      const Vector3d hub_B = a.specific_force_B + a.angular_B.cross(r) + m.rates_B.cross(m.rates_B.cross(r));
      y.head<3>() = polar_.cwiseProduct(R_BH_.transpose() * hub_B);
      y.tail<3>() = axial_.cwiseProduct(R_BH_.transpose() * a.angular_B);
      break;
    }
    case kHubWind: y = polar_.cwiseProduct(R_BH_.transpose() * (m.R_OB.transpose() * u.segment<3>(kWind))); break;
    case kPositionOut: y = m.position_O; break;
    case kOrientationOut: y << m.orientation.w(), m.orientation.vec(); break;
    case kFuselageVelocity: y = m.velocity_B; break;
    case kRates: y = m.rates_B; break;
    case kHubForce: y = polar_.cwiseProduct(u.segment<3>(kRotorForce)); break;
    case kHubMoment: y = axial_.cwiseProduct(u.segment<3>(kTiltingMoment)); break;
    case kHubPosition: y = m.position_O + m.R_OB * r; break;
    case kHubOrientation: {
      const Eigen::Quaterniond hub = m.orientation * Eigen::Quaterniond(Eigen::AngleAxisd(p_.shaft_tilt_forward, Vector3d::UnitY()));
      y << hub.w(), hub.vec();
      break;
    }
    case kHubGravity: y = polar_.cwiseProduct(R_BH_.transpose() * (m.R_OB.transpose() * Vector3d(0.0, 0.0, -p_.gravity))); break;
    case kLinearMomentum: y = momentum(m).linear_O; break;
    case kAngularMomentum: y = momentum(m).angular_O; break;
    case kEnergy: y[0] = energy(m); break;
    case kSpringWrench: y = springWrench(m); break;
  }
}

bool Mount::outputJacobian(Index port, double, const In& x, const In&, Eigen::Map<Matrix> jacobian) noexcept {
  switch (port) {
    case kAcceleration: jacobian.leftCols<kLoads>() = load_gain_; return true;
    case kHubWind: jacobian.middleCols<3>(kWind) = polar_.asDiagonal() * (R_BH_.transpose() * motion(x).R_OB.transpose()); return true;
    case kHubForce: jacobian.middleCols<3>(kRotorForce).diagonal() = polar_; return true;
    case kHubMoment: jacobian.middleCols<3>(kTiltingMoment).diagonal() = axial_; return true;
    default: return false;
  }
}

FuselageMotion RigidMount::motion(const In&) const noexcept {
  return {Vector3d::Zero(), p_.orientation, p_.orientation.toRotationMatrix(), Vector3d::Zero(), Vector3d::Zero()};
}

Mount::Acceleration RigidMount::acceleration(const FuselageMotion& motion, const In&) const noexcept {
  return {motion.R_OB.transpose() * Vector3d(0.0, 0.0, p_.gravity), Vector3d::Zero()};
}

Made makeMount(Section& section, const BuildContext&) {
  const MountParameters p = readMountParameters(section);
  switch (p.mode) {
    case MountMode::kRigid: return std::make_unique<RigidMount>(p);
    case MountMode::kSpring2: return std::make_unique<PlanarMount>(p);
    default: return std::make_unique<RigidBodyMount>(p);
  }
}

}  // namespace heerk_rotor
