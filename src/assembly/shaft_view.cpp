#include "heerk_rotor/assembly/shaft_view.hpp"

#include <stdexcept>
#include <string>

#include "heerk_rotor/assembly/non_finite.hpp"

namespace heerk_rotor {
namespace {

const char* const kViewer = "shaft view";

/// Pairs x, y.
PortRange findPairs(const CoupledSystem& system, const std::string& quantity) {
  const PortRange range = findPort(system, kViewer, quantity, 0);
  if (range.size % 2 != 0)
    throw std::invalid_argument(std::string(kViewer) + ": " + quantity + " has " + std::to_string(range.size) + " entries, expected an even number (x, y, x, y, ..)");
  return range;
}

}  // namespace

bool isFinite(const ShaftReading& r) noexcept {
  const std::array<double, 10> values = {r.azimuth,         r.rotor_speed,     r.journal_x,    r.journal_y,   r.eccentricity_ratio,
                                         r.bearing_force_x, r.bearing_force_y, r.film_force_x, r.film_force_y, r.sim_time};
  return nonFinite(values) + nonFinite(r.disc_x) + nonFinite(r.disc_y) == 0.0;
}

ShaftView::ShaftView(const CoupledSystem& system)
    : displacement_(findPairs(system, "displacement")),
      journal_motion_(findPort(system, kViewer, "journal_motion", 4)),
      bearing_force_(findPairs(system, "bearing_force")),
      film_force_(findPort(system, kViewer, "film_force", 2)),
      eccentricity_ratio_(findPort(system, kViewer, "eccentricity_ratio", 1)),
      azimuth_(findPort(system, kViewer, "azimuth", 1)),
      rotor_speed_(findPort(system, kViewer, "rotor_speed", 1)) {
  if (discs() > ShaftReading::kMaxDiscs)
    throw std::invalid_argument(std::string(kViewer) + ": displacement has " + std::to_string(discs()) + " discs, expected at most " + std::to_string(ShaftReading::kMaxDiscs));
}

void ShaftView::read(const Sample& sample, ShaftReading& reading) const noexcept {
  const auto value = [&sample](const PortRange& range, Index entry) { return entry < range.size ? sample.y[range.begin + entry] : 0.0; };
  reading.step = sample.step;
  reading.epoch = sample.epoch;
  reading.sim_time = sample.t;
  reading.discs = discs();
  reading.azimuth = value(azimuth_, 0);
  reading.rotor_speed = value(rotor_speed_, 0);
  for (Index disc = 0; disc < reading.discs; ++disc) {
    reading.disc_x[static_cast<std::size_t>(disc)] = value(displacement_, 2 * disc);
    reading.disc_y[static_cast<std::size_t>(disc)] = value(displacement_, 2 * disc + 1);
  }
  reading.journal_x = value(journal_motion_, 0);
  reading.journal_y = value(journal_motion_, 1);
  reading.eccentricity_ratio = value(eccentricity_ratio_, 0);
  reading.bearing_force_x = value(bearing_force_, 0);
  reading.bearing_force_y = value(bearing_force_, 1);
  reading.film_force_x = value(film_force_, 0);
  reading.film_force_y = value(film_force_, 1);
  reading.newton_iterations = static_cast<std::uint32_t>(sample.newton_iterations);
  reading.residual_evaluations = static_cast<std::uint32_t>(sample.residual_evaluations);
}

}  // namespace heerk_rotor
