#pragma once
#include <string>
#include <vector>

namespace heerk_rotor {

/// One block of a C81 deck: a coefficient over its own grid.
struct C81Block {
  std::vector<double> mach;       // strictly increasing [-]
  std::vector<double> alpha_deg;  // strictly increasing [deg]
  std::vector<double> values;     // (alpha x mach), row by row [-]

  double value(std::size_t i_alpha, std::size_t i_mach) const { return values[i_alpha * mach.size() + i_mach]; }
  double& value(std::size_t i_alpha, std::size_t i_mach) { return values[i_alpha * mach.size() + i_mach]; }
};

/// An airfoil in the C81 format: lift, drag and moment (about the quarter chord, nose up positive).
struct C81Deck {
  std::string name;
  C81Block lift, drag, moment;
};

}  // namespace heerk_rotor
