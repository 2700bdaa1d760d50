#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/models/fe_rotor_parameters.hpp"

namespace heerk_rotor {

/// Quadratic forms of one blade in nodal displacements, see BladeMatrices.
enum BladeForm { kFormMean, kFormCosine, kFormSine, kFormSpin, kFormShortening, kFormCoriolis, kFormOffsetV, kFormOffsetW, kForms };

/// Linear forms of one blade in nodal displacements.
enum BladeLine { kLineMean, kLineCosine, kLineSine, kLineSpin, kLineU, kLineV, kLineW, kLineRV, kLineRW, kLineTwist, kLines };

/// The numbers with which blades are computed in lanes: rounded once from the 80-bit matrices of the beam room and laid out in the order
/// of use. Each coefficient stands once where all blades are equal, or once per lane ("copies").
/// Nodal arrays hold all 5 degrees of freedom of every node, zero where held, and are padded to whole blocks of kBlock.
struct BladeCoefficients {
  static constexpr int kBlock = 4;
  static constexpr int kBand = 15;  // a node's row reaches its own and both neighbours' degrees of freedom

  BladeCoefficients(const FeRotorParameters& parameters, int lanes);

  int blades, lanes, copies;
  int nodes, dofs, modes, sections;  // dofs = 5 nodes
  int dof_blocks, mode_blocks;
  int forms;                         // kForms, or kFormOffsetV where all mass centres lie on the elastic axis

  std::vector<double> omega, damping;             // [mode][blade] of the S that the state uses
  std::vector<double> stiffness, mode_damping;    // [mode][copy] omega^2, c
  std::vector<double> to_nodes;                   // [dof block][mode][kBlock][copy]: V
  std::vector<double> to_modes;                   // [mode block][dof][kBlock][copy]: V'
  std::vector<double> band;                       // [dof][kBand][form][copy]
  std::vector<double> lines;                      // [dof][line][copy]
  std::vector<double> hub_rows;                   // [6][mode][copy]: u, v, w, twist, -rw, rv: modal loads of unit hub accelerations
  std::vector<double> hinge_damping;              // [2][copy]: of the root slopes in v and in w
  std::vector<double> rigid;                      // [10][copy]: mass, first moment x y z, inertia xx yy zz xy xz yz
  double nominal_mean, nominal_spin, nominal_lead_v;  // contained in S: Omega^2 cos^2 p, Omega^2 sin^2 p and Omega^2 e0

  struct SectionShape {
    int element;                 // left node
    double radius;               // [m]
    double v[4], slope[4];       // cubic Hermite: left value, left slope, right value, right slope
    double twist[2];             // linear
    double built_in_twist;       // [rad]
  };
  std::vector<SectionShape> shapes;  // sections, then the tip

  std::vector<std::string> state_names;  // [mode][blade], "L1_1"
};

}  // namespace heerk_rotor
