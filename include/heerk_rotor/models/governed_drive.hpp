#pragma once
#include "heerk_rotor/core/subsystem_model.hpp"

namespace heerk_rotor {

/// Drive train with an engine: the speed follows from the balance of torques, held by a PI governor or by nothing.
///
///   I (rate' + r') = Q_engine + Q_mast,   angle' = rate
///   Q_engine = centre + span tanh(q / (s_0 span) + atanh((Q_0 - centre) / span)),   q = Kp e + z,   e = clamp(speed command) - Omega - rate
///   z' = Ki e s / s_0,   s = slope of the tanh,   s_0 = s at Q_0
/// Q_mast is mast.torque, the torque of the mast on its lower end about +z: negative while the engine pulls the rotor. r' is the yaw
/// acceleration of the mount. centre and span are half sum and half difference of max_torque and min_torque. The limiter is smooth, because f
/// and g of the coupled system must be differentiable; it is placed so that the engine gives Q_0, and the gains are Kp and Ki, at q = 0.
/// s lets the integral rest while the engine is at a limit (no wind-up), and leaves no steady error between the limits.
/// Without governor Q_engine = Q_0, 0 for autorotation: the rotor finds its speed, and there is neither z nor a speed command.
///
/// Angle and rate are relative to Omega t and to the mount. I is the inertia of engine and gearbox at rotor speed, taken to turn about the mast's
/// axis. The engine sits in the mount and turns itself back: torque = -Q_engine is what the mount receives, INSTEAD of mast.torque, which
/// acts on this inertia here. (`drive` has no inertia and hides its engine; there mast.torque reaches the mount directly.)
///
/// States: angle [rad], rate [rad/s], integral z [N m]. Inputs: speed_command; mast_torque (with an elastic mast a function of its state: no
/// loop; a rigid mast closes one, of gain -hub inertia / I); mount_velocity and mount_acceleration (mount_ports.hpp). The last one puts the
/// drive into the loop of the mount's acceleration; left out, the drive's inertia does not notice that the mount yaws.
/// Outputs: drive (angle, rate, acceleration) for the mast; torque; engine_torque; gyroscopic_moment and drive_angular_momentum, as the mast's.
class GovernedDrive : public SubsystemModel {
 public:
  struct Parameters {
    double rotor_speed = 0.0;          // Omega [rad/s]
    double inertia = 200.0;            // I [kg m^2], ASSUMED as all below: light helicopter of 2 t, 630 kW at 44 rad/s
    bool governor = true;
    double proportional_gain = 5000.0; // Kp [N m s/rad]
    double integral_gain = 5000.0;     // Ki [N m/rad]
    double engine_torque = 7000.0;     // Q_0 [N m]
    double min_torque = 0.0;           // a freewheel does not brake [N m]
    double max_torque = 14000.0;       // [N m]
    double min_speed = 0.0;            // commands below are taken as this [rad/s]
    double max_speed = 0.0;            // commands above are taken as this [rad/s]
  };
  /// With a governor min_torque < engine_torque < max_torque.
  explicit GovernedDrive(const Parameters& parameters);

  std::vector<State> states() const override;
  std::vector<std::string> ignoredInitialValues() const override;
  std::vector<InputPort> inputs() const override;
  std::vector<OutputPort> outputs() const override;
  void evalOutput(Index port, double t, const In& x, const In& u, Out y) noexcept override;
  void evalDerivatives(double t, const In& x, const In& u, Out xdot) noexcept override;
  bool outputJacobian(Index port, double t, const In& x, const In& u, Eigen::Map<Matrix> jacobian) noexcept override;

 private:
  double speedError(const In& x, const In& u) const noexcept;
  double engineTorque(const In& x, const In& u, double& slope) const noexcept;  // slope: s / s_0
  double acceleration(const In& x, const In& u) const noexcept;
  double angularMomentum(const In& x, const In& u) const noexcept;

  Parameters p_;
  double centre_, span_, offset_, slope_at_trim_;  // of the limiter [N m], [N m], [-], [-]
};

}  // namespace heerk_rotor
