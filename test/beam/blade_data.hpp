#pragma once
#include <cmath>

#include "heerk_rotor/beam/blade_properties.hpp"

namespace heerk_rotor {

/// n + 1 nodes from `root` to `tip`, equally spaced.
inline std::vector<double> equalNodes(int elements, double root, double tip) {
  std::vector<double> nodes;
  for (int i = 0; i <= elements; ++i) nodes.push_back(root + (tip - root) * i / elements);
  return nodes;
}

/// Uniform blade of radius 1 m, mass 1 kg/m and flap stiffness 1 N m^2: frequencies are the dimensionless ones and omega is eta. Lag and
/// torsion are far above.
inline BladeProperties uniformBlade(int elements, double root = 0.0) {
  BladeProperties p;
  p.nodes = equalNodes(elements, root, 1.0);
  p.mass = {1.0};
  p.EI_flap = {1.0};
  p.EI_lag = {1e4};
  p.GJ = {10.0};
  p.km2 = {0.01};
  return p;
}

/// Bo105-class main rotor blade; sources of the numbers: config/bo105.yaml. `refine`: each element becomes that many.
inline BladeProperties bo105Blade(int refine = 1) {
  const std::vector<double> coarse = {0.20, 0.285, 0.37, 0.60, 1.08, 1.7183333333333333, 2.3566666666666667,
                                      2.995, 3.6333333333333333, 4.271666666666667, 4.91};
  BladeProperties p;
  for (std::size_t i = 0; i + 1 < coarse.size(); ++i)
    for (int k = 0; k < refine; ++k) p.nodes.push_back(coarse[i] + (coarse[i + 1] - coarse[i]) * k / refine);
  p.nodes.push_back(coarse.back());
  p.stations = {0.20, 0.37, 0.60, 4.91};
  p.mass = {22.20, 22.20, 5.55, 5.55};
  p.EI_flap = {69600, 69600, 8700, 8700};
  p.EI_lag = {656000, 656000, 82000, 82000};
  p.GJ = {46400, 46400, 5800, 5800};
  p.km1 = {0.0075};
  p.km2 = {0.0730};
  p.kA = {0.0730};
  p.twist = linearTwist(p.stations, -8.0 * M_PI / 180, 4.91, 0.75 * 4.91);
  p.damping_mass = 0.5;
  p.damping_stiffness = 1e-7;
  return p;
}
constexpr double kBo105Omega = 44.40;  // [rad/s]

/// HART II model blade: 40 % Mach-scaled Bo105.
inline BladeProperties hart2Blade() {
  BladeProperties p;
  p.nodes = {0.075, 0.13, 0.185, 0.24, 0.44, 0.70, 0.96, 1.22, 1.48, 1.74, 2.0};
  p.stations = {0.075, 0.24, 0.44, 2.0};
  p.mass = {2.85, 2.85, 0.95, 0.95};
  p.EI_flap = {1050, 1050, 250, 250};
  p.EI_lag = {4594, 4594, 5200, 5200};
  p.GJ = {480, 480, 160, 160};
  p.km1 = {0.003};
  p.km2 = {0.0290};
  p.twist = linearTwist(p.stations, -8.0 * M_PI / 180, 2.0, 1.5);
  p.damping_mass = 1.0;
  p.damping_stiffness = 1e-7;
  return p;
}
constexpr double kHart2Omega = 109.12;  // [rad/s]

}  // namespace heerk_rotor
