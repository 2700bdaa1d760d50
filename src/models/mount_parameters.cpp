#include "heerk_rotor/models/mount_parameters.hpp"

#include <Eigen/Eigenvalues>

namespace heerk_rotor {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// A list of exactly the fallback's size.
template <int N>
Eigen::Matrix<double, N, 1> readVector(Section& section, const std::string& key, const Eigen::Matrix<double, N, 1>& fallback, const std::string& unit, Range range = anyNumber()) {
  const std::size_t problems_before = section.problems().list().size();
  const std::vector<double> values = section.list(key, std::vector<double>(fallback.data(), fallback.data() + N), unit, range);
  if (values.size() == static_cast<std::size_t>(N)) return Eigen::Map<const Eigen::Matrix<double, N, 1>>(values.data());
  if (section.problems().list().size() == problems_before) section.problem(key, "a list of " + std::to_string(N) + " numbers [" + unit + "]");
  return fallback;
}

/// One number for both axes, or a list of two.
Eigen::Vector2d readPair(Section& section, const std::string& key, double fallback, const std::string& unit, Range range) {
  const std::vector<double> values = section.numbers(key, 2, fallback, unit, range);
  return {values[0], values[1]};
}

void readGeometry(Section& section, MountParameters& p) {
  p.hub_offset = readVector<3>(section, "hub_offset", p.hub_offset, "m");
  p.shaft_tilt_forward = kDegree * section.number("shaft_tilt_forward_deg", 0.0, "deg", {-90.0, 90.0, false});
  const Range turn{-360.0, 360.0, false};
  const double roll = section.number("roll_deg", 0.0, "deg", turn), pitch = section.number("pitch_deg", 0.0, "deg", turn);
  const double heading = section.number("heading_deg", 0.0, "deg", turn);
  p.orientation = Eigen::AngleAxisd(kDegree * heading, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(kDegree * pitch, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(kDegree * roll, Eigen::Vector3d::UnitX());
  p.clockwise = section.word("rotation", "ccw", {"ccw", "cw"}) == "cw";
}

/// Inertia about the centre of gravity: a body with such moments must exist.
void readInertia(Section& section, MountParameters& p) {
  const Eigen::Vector3d moments = readVector<3>(section, "inertia", p.inertia.diagonal(), "kg m^2", positive());
  const Eigen::Vector3d products = readVector<3>(section, "products_of_inertia", Eigen::Vector3d::Zero(), "kg m^2");
  Eigen::Matrix3d inertia = moments.asDiagonal();
  inertia(0, 1) = inertia(1, 0) = -products[0];
  inertia(0, 2) = inertia(2, 0) = -products[1];
  inertia(1, 2) = inertia(2, 1) = -products[2];
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  // x^2 + y^2 <= (y^2 + z^2) + (z^2 + x^2) for every mass point; a plate reaches equality.
  const bool possible = principal[0] > 0.0 && principal[2] <= (principal[0] + principal[1]) * (1.0 + 1e-12);
  if (possible) p.inertia = inertia;
  else section.problem(section.has("products_of_inertia") ? "products_of_inertia" : "inertia",
                       "moments of inertia of a body: all principal moments > 0, none larger than the sum of the other two [kg m^2]");
}

void readGear(Section& section, MountParameters& p) {
  p.gear_stiffness = readVector<6>(section, "gear_stiffness", p.gear_stiffness, "N/m, N m/rad", nonNegative());
  p.gear_damping = readVector<6>(section, "gear_damping", p.gear_damping, "N s/m, N m s/rad", nonNegative());
  p.gear_position = readVector<3>(section, "gear_position", p.gear_position, "m");
  const bool preload = section.flag("gear_preload", true);
  p.gear_preload_mass = section.number("gear_preload_mass", p.mass, "kg", nonNegative());
  if (!preload && section.has("gear_preload_mass")) section.problem("gear_preload_mass", "not given, as gear_preload is false");
  if (!preload) p.gear_preload_mass = 0.0;
}

void readPlanarSupport(Section& section, MountParameters& p) {
  if (section.has("mass") && (section.has("mass_x") || section.has("mass_y"))) section.problem("mass", "either mass, or mass_x and mass_y");
  p.planar_mass = {section.number("mass_x", p.mass, "kg", positive()), section.number("mass_y", p.mass, "kg", positive())};
  const Eigen::Vector2d frequency = readPair(section, "frequency", 18.8495559215, "rad/s", nonNegative());  // 3 Hz
  const Eigen::Vector2d stiffness = readPair(section, "stiffness", 0.0, "N/m", nonNegative());
  if (section.has("frequency") && section.has("stiffness")) section.problem("frequency", "either frequency or stiffness");
  p.planar_stiffness = section.has("stiffness") ? stiffness : Eigen::Vector2d(p.planar_mass.cwiseProduct(frequency.cwiseAbs2()));
  p.planar_damping = readPair(section, "damping", 0.0, "N s/m", nonNegative());
}

}  // namespace

MountParameters readMountParameters(Section& section) {
  MountParameters p;
  const std::string mode = section.word("mode", "free", {"rigid", "spring2", "spring6", "free"});
  p.mode = mode == "rigid" ? MountMode::kRigid : mode == "spring2" ? MountMode::kSpring2 : mode == "spring6" ? MountMode::kSpring6 : MountMode::kFree;
  readGeometry(section, p);
  p.gravity = section.number("gravity", p.gravity, "m/s^2", nonNegative());
  p.wind = readVector<3>(section, "wind", p.wind, "m/s");
  p.mass = section.number("mass", p.mass, "kg", positive());
  readInertia(section, p);
  p.norm_feedback = section.number("norm_feedback", p.norm_feedback, "1/s", nonNegative());
  readGear(section, p);
  readPlanarSupport(section, p);
  section.finish();
  return p;
}

}  // namespace heerk_rotor
