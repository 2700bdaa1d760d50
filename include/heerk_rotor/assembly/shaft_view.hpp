#pragma once
#include <array>
#include <cstdint>

#include "heerk_rotor/assembly/port_range.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// What the outside world is told about one instant of a flexible shaft with discs, in SI units; z along the shaft, x and y
/// transverse and fixed in space, displacements from the static position (ShaftState.msg). Fixed size, so that it can travel
/// through a lock-free ring, and small: a shaft makes 100 000 steps per second.
struct ShaftReading {
  static constexpr int kMaxDiscs = 4;
  std::uint64_t step = 0;
  std::uint32_t epoch = 0;
  std::int32_t discs = 0;                                    // entries in use below
  double sim_time = 0.0;                                     // [s]
  double azimuth = 0.0;                                      // unwrapped [rad]
  double rotor_speed = 0.0;                                  // [rad/s]
  std::array<double, kMaxDiscs> disc_x{}, disc_y{};          // of the centres [m]
  double journal_x = 0.0, journal_y = 0.0;                   // in the film damper [m]
  double eccentricity_ratio = 0.0;                           // of the journal from the housing centre, 1 = contact [-]
  double bearing_force_x = 0.0, bearing_force_y = 0.0;       // of the left bearing on the shaft [N]
  double film_force_x = 0.0, film_force_y = 0.0;             // of the film on the journal [N]
  std::uint32_t newton_iterations = 0, residual_evaluations = 0;  // spent since the previous step
};

/// True when every number that comes from the simulation is finite.
bool isFinite(const ShaftReading& reading) noexcept;

/// Finds the quantities of a ShaftReading in any coupled system, by output port name whatever subsystem offers them:
///   displacement (x, y per disc), journal_motion (x, y and their rates), bearing_force (x, y per bearing; the first counts),
///   film_force (2), eccentricity_ratio, azimuth, rotor_speed. What is absent stays zero.
class ShaftView {
 public:
  using Reading = ShaftReading;

  /// Throws std::invalid_argument when two subsystems offer the same quantity or sizes do not fit.
  explicit ShaftView(const CoupledSystem& system);

  int discs() const { return static_cast<int>(displacement_.size / 2); }

  /// Allocation free.
  void read(const Sample& sample, ShaftReading& reading) const noexcept;

 private:
  PortRange displacement_, journal_motion_, bearing_force_, film_force_, eccentricity_ratio_, azimuth_, rotor_speed_;
};

}  // namespace heerk_rotor
