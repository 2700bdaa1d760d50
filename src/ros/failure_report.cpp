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

struct ScalarColumn {
  const char* name;
  const char* unit;
  double RotorReading::*value;
};
constexpr ScalarColumn kScalars[] = {{"rotor_speed", "rad/s", &RotorReading::rotor_speed},
                                     {"thrust_coefficient", "-", &RotorReading::thrust_coefficient},
                                     {"torque_coefficient", "-", &RotorReading::torque_coefficient},
                                     {"collective", "rad", &RotorReading::collective},
                                     {"lateral_cyclic", "rad", &RotorReading::lateral_cyclic},
                                     {"longitudinal_cyclic", "rad", &RotorReading::longitudinal_cyclic}};

}  // namespace

void writeFailureHistory(const std::string& file, const std::vector<RotorInstant>& history) {
  const int blades = history.empty() ? 0 : history.front().reading.blades;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(17);

  text << "step [-],time [s],azimuth [rad]";
  for (const ScalarColumn& column : kScalars) text << ',' << column.name << " [" << column.unit << ']';
  for (const PerBladeColumn& column : kPerBlade)
    for (int k = 1; k <= blades; ++k) text << ',' << column.name << '_' << k << " [" << column.unit << ']';
  for (const VectorColumn& column : kVectors)
    for (const char axis : {'x', 'y', 'z'}) text << ',' << column.name << '_' << axis << " [" << column.unit << ']';
  text << ",newton_iterations [-],command_source [-]\n";

  for (const RotorInstant& instant : history) {
    const RotorReading& r = instant.reading;
    text << r.step << ',' << r.sim_time << ',' << r.azimuth;
    for (const ScalarColumn& column : kScalars) text << ',' << r.*column.value;
    for (const PerBladeColumn& column : kPerBlade)
      for (int k = 0; k < blades; ++k) text << ',' << (r.*column.values)[static_cast<std::size_t>(k)];
    for (const VectorColumn& column : kVectors)
      for (const double value : r.*column.values) text << ',' << value;
    text << ',' << r.newton_iterations << ',' << name(instant.source) << '\n';
  }
  replaceFile(file, text.str());
}

}  // namespace heerk_rotor
