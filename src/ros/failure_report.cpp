#include "heerk_rotor/ros/failure_report.hpp"

#include <locale>
#include <sstream>

#include "heerk_rotor/assembly/file_replacement.hpp"

namespace heerk_rotor {
namespace {

struct PerBladeColumn {
  const char* name;
  const char* unit;
  RotorReading::PerBlade RotorReading::*values;
};
constexpr PerBladeColumn kPerBlade[] = {{"lag", "rad", &RotorReading::lag},     {"lag_rate", "rad/s", &RotorReading::lag_rate},
                                        {"flap", "rad", &RotorReading::flap},   {"flap_rate", "rad/s", &RotorReading::flap_rate},
                                        {"pitch", "rad", &RotorReading::pitch}, {"pitch_rate", "rad/s", &RotorReading::pitch_rate},
                                        {"tip_twist", "rad", &RotorReading::tip_twist}};

struct VectorColumn {
  const char* name;
  const char* unit;
  std::array<double, 3> RotorReading::*values;
};
constexpr VectorColumn kVectors[] = {{"hub_force", "N", &RotorReading::hub_force},
                                     {"hub_moment", "N m", &RotorReading::hub_moment},
                                     {"position", "m", &RotorReading::position},
                                     {"velocity", "m/s", &RotorReading::velocity}};

template <class Reading>
struct ScalarColumn {
  const char* name;
  const char* unit;
  double Reading::*value;
};
constexpr ScalarColumn<RotorReading> kScalars[] = {{"rotor_speed", "rad/s", &RotorReading::rotor_speed},
                                     {"thrust_coefficient", "-", &RotorReading::thrust_coefficient},
                                     {"torque_coefficient", "-", &RotorReading::torque_coefficient},
                                     {"collective", "rad", &RotorReading::collective},
                                     {"lateral_cyclic", "rad", &RotorReading::lateral_cyclic},
                                     {"longitudinal_cyclic", "rad", &RotorReading::longitudinal_cyclic}};

constexpr ScalarColumn<ShaftReading> kShaftScalars[] = {{"rotor_speed", "rad/s", &ShaftReading::rotor_speed},
                                                        {"journal_x", "m", &ShaftReading::journal_x},
                                                        {"journal_y", "m", &ShaftReading::journal_y},
                                                        {"eccentricity_ratio", "-", &ShaftReading::eccentricity_ratio},
                                                        {"bearing_force_x", "N", &ShaftReading::bearing_force_x},
                                                        {"bearing_force_y", "N", &ShaftReading::bearing_force_y},
                                                        {"film_force_x", "N", &ShaftReading::film_force_x},
                                                        {"film_force_y", "N", &ShaftReading::film_force_y}};

/// Begun with the columns that every history has.
std::ostringstream table() {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);
  text << "step [-],time [s],azimuth [rad]";
  return text;
}

}  // namespace

void writeFailureHistory(const std::string& file, const std::vector<RotorInstant>& history) {
  const int blades = history.empty() ? 0 : history.front().reading.blades;
  std::ostringstream text = table();
  for (const auto& column : kScalars) text << ',' << column.name << " [" << column.unit << ']';
  for (const PerBladeColumn& column : kPerBlade)
    for (int k = 1; k <= blades; ++k) text << ',' << column.name << '_' << k << " [" << column.unit << ']';
  for (const VectorColumn& column : kVectors)
    for (const char axis : {'x', 'y', 'z'}) text << ',' << column.name << '_' << axis << " [" << column.unit << ']';
  text << ",newton_iterations [-],command_source [-]\n";

  for (const RotorInstant& instant : history) {
    const RotorReading& r = instant.reading;
    text << r.step << ',' << r.sim_time << ',' << r.azimuth;
    for (const auto& column : kScalars) text << ',' << r.*column.value;
    for (const PerBladeColumn& column : kPerBlade)
      for (int k = 0; k < blades; ++k) text << ',' << (r.*column.values)[static_cast<std::size_t>(k)];
    for (const VectorColumn& column : kVectors)
      for (const double value : r.*column.values) text << ',' << value;
    text << ',' << r.newton_iterations << ',' << name(instant.source) << '\n';
  }
  replaceFile(file, text.str());
}

void writeFailureHistory(const std::string& file, const std::vector<ShaftInstant>& history) {
  const int discs = history.empty() ? 0 : history.front().reading.discs;
  std::ostringstream text = table();
  for (const auto& column : kShaftScalars) text << ',' << column.name << " [" << column.unit << ']';
  for (int disc = 1; disc <= discs; ++disc) text << ",disc_" << disc << "_x [m],disc_" << disc << "_y [m]";
  text << ",newton_iterations [-]\n";
  for (const ShaftInstant& instant : history) {
    const ShaftReading& r = instant.reading;
    text << r.step << ',' << r.sim_time << ',' << r.azimuth;
    for (const auto& column : kShaftScalars) text << ',' << r.*column.value;
    for (std::size_t disc = 0; disc < static_cast<std::size_t>(discs); ++disc) text << ',' << r.disc_x[disc] << ',' << r.disc_y[disc];
    text << ',' << r.newton_iterations << '\n';
  }
  replaceFile(file, text.str());
}

}  // namespace heerk_rotor
