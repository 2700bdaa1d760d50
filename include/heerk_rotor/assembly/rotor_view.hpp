#pragma once
#include <array>

#include "heerk_rotor/assembly/command_view.hpp"
#include "heerk_rotor/assembly/port_range.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// What the outside world is told about one instant of a rotor, in SI units and ROS axes (interface.md). Fixed size, so
/// that it can travel through a lock-free ring.
struct RotorReading {
  static constexpr int kMaxBlades = 8;
  static constexpr int kMaxInflow = 8;
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  double sim_time = 0.0;      // [s]
  int blades = 0;             // entries in use below
  double azimuth = 0.0;       // unwrapped hub angle [rad]
  double rotor_speed = 0.0;   // of the hub [rad/s]
  using PerBlade = std::array<double, kMaxBlades>;
  PerBlade lag{}, lag_rate{}, flap{}, flap_rate{}, pitch{}, pitch_rate{}, tip_twist{};  // [rad], [rad/s]; lead, up, nose up positive
  double lag_collective = 0, lag_cosine = 0, lag_sine = 0;                 // multiblade coordinates [rad]
  double flap_collective = 0, flap_cosine = 0, flap_sine = 0;
  std::array<double, 3> hub_force{}, hub_moment{};                         // rotor on fuselage, in hub_link [N], [N m]
  std::array<double, 3> position{}, velocity{}, angular_velocity{};        // base_link in odom; velocities in base_link
  std::array<double, 4> orientation{{1, 0, 0, 0}};                         // w x y z
  double thrust_coefficient = 0, torque_coefficient = 0, power_coefficient = 0, advance_ratio = 0;
  int inflow_states = 0;
  std::array<double, kMaxInflow> inflow{};
  double collective = 0, lateral_cyclic = 0, longitudinal_cyclic = 0;      // command in effect [rad]
  std::uint32_t newton_iterations = 0, residual_evaluations = 0;           // spent since the previous step
};

/// True when every number that comes from the simulation is finite.
bool isFinite(const RotorReading& reading) noexcept;

/// Finds the quantities of a RotorReading in any coupled system, by output port name whatever subsystem offers them:
///   azimuth, rotor_speed, lag, lag_rate, flap, flap_rate, pitch, pitch_rate, tip_twist (one entry per blade),
///   hub_force (3), hub_moment (3), fuselage_position (3), fuselage_velocity (3), fuselage_orientation (4), fuselage_rates (3),
///   thrust_coefficient, torque_coefficient, power_coefficient, advance_ratio, inflow (any size),
/// and the swashplate's commands in effect (CommandView). What is absent stays zero (orientation: identity).
class RotorView {
 public:
  using Reading = RotorReading;

  /// Throws std::invalid_argument when two subsystems offer the same quantity or take the same command, or sizes disagree.
  explicit RotorView(const CoupledSystem& system);

  int blades() const { return blades_; }

  /// Allocation free.
  void read(const Sample& sample, RotorReading& reading) const noexcept;

 private:
  PortRange azimuth_, rotor_speed_, lag_, lag_rate_, flap_, flap_rate_, pitch_, pitch_rate_, tip_twist_, hub_force_, hub_moment_,
      position_, velocity_, orientation_, rates_, thrust_coefficient_, torque_coefficient_, power_coefficient_,
      advance_ratio_, inflow_;
  CommandView commands_;
  int blades_ = 0;
};

}  // namespace heerk_rotor
