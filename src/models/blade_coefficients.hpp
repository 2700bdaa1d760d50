#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "heerk_rotor/models/fe_rotor_parameters.hpp"

namespace heerk_rotor {

/// Quadratic forms of one blade in nodal displacements, see BladeMatrices.
enum BladeForm { kFormMean, kFormCosine, kFormSine, kFormSpin, kFormShortening, kFormCoriolis, kFormOffsetV, kFormOffsetW, kForms };

/// Linear forms of one blade in nodal displacements. The first kLoadLines are loads of the blade's rotation.
enum BladeLine { kLineMean, kLineCosine, kLineSine, kLineSpin, kLineRV, kLineRW, kLoadLines, kLineU = kLoadLines, kLineV, kLineW, kLineTwist, kLines };

/// Kinds of nodal displacements: v and its slope, w and its slope, twist.
enum DofKind { kLagDofs, kFlapDofs, kTwistDofs, kDofKinds };
constexpr int kKindSize[kDofKinds] = {2, 2, 1};  // per node

/// Accelerations of the hub, as the blades see them: of the origin and angular ones, in B. Each loads every mode ("rows").
enum HubRow { kRowX, kRowY, kRowZ, kRowTurnX, kRowTurnY, kRowTurnZ, kHubRows };
constexpr int kHubPairs = kHubRows * (kHubRows + 1) / 2;
/// Index of the pair (i, j) of hub rows, i <= j, in a symmetric matrix.
constexpr int hubPair(int i, int j) { return i * kHubRows - i * (i - 1) / 2 + j - i; }

/// The numbers with which blades are computed in lanes: rounded once from the 80-bit matrices of the beam room and laid out in the order
/// of use. Each coefficient stands once where all blades are equal, or once per lane ("copies"). What is zero for every blade is left out,
/// of V as far as tiles allow.
///
/// Nodal arrays run by kind of displacement, then node, then value and slope: [lag | flap | twist][node][kKindSize], with a node of zeros
/// on both sides of each kind, so that every node has two neighbours. Held degrees of freedom stay zero. The last entry belongs to none.
struct BladeCoefficients {
  static constexpr int kTile = 5;    // rows and modes of a tile of V

  BladeCoefficients(const FeRotorParameters& parameters, int lanes);

  int blades, lanes, copies;
  int nodes, modes, sections;
  int first_node;                    // 1 where the root is clamped, 0 where a hinge frees it
  bool offset;                       // mass centres beside the elastic axis: E_v and E_w are not zero
  int kind_begin[kDofKinds];         // of the first node in nodal arrays
  int nodal_size;

  int rows(int kind) const { return nodes * kKindSize[kind]; }

  std::vector<double> omega, damping;             // [mode][blade] of the S that the state uses
  /// Modal arrays run in an order of their own, in which modes that move the same kinds of displacements stand side by side.
  std::vector<int> mode_order;                    // [modal entry] mode
  std::vector<double> stiffness, mode_damping;    // [modal entry][copy] omega^2, c

  int modalSize() const { return mode_tiles * kTile; }  // of modal arrays; the entries beyond the modes stay zero

  /// V in tiles of kTile rows, which have their places in nodal arrays, and kTile modal entries. Rows that move in the same modes stand side by side, too,
  /// so that most tiles of zeros lie outside of the ranges.
  struct TileRange {
    int begin, end;
    TileRange with(const TileRange& other) const { return {std::min(begin, other.begin), std::max(end, other.end)}; }
  };
  int row_tiles, mode_tiles;
  std::vector<int> row_position;           // [row]; the last entry of nodal arrays for rows that only fill a tile
  std::vector<TileRange> modes_of_rows;    // [row tile] mode tiles
  std::vector<TileRange> rows_of_modes;    // [mode tile] row tiles
  std::vector<double> V;                   // [row tile][mode tile][mode][row][copy]
  std::ptrdiff_t nextModeTile() const { return kTile * kTile * copies; }
  std::ptrdiff_t nextRowTile() const { return mode_tiles * nextModeTile(); }
  const double* tile(int row_tile, int mode_tile) const { return V.data() + row_tile * nextRowTile() + mode_tile * nextModeTile(); }

  /// The nodal loads of one kind are a sum over slots: linear forms first, then products of the displacements, then of their rates.
  int slots[kDofKinds];

  /// The rows of one kind and the columns of another kind of one form, or of several forms that are multiples of each other there.
  /// A node's rows reach its own and both neighbours' degrees of freedom.
  struct FormPart {
    int row, column;                 // DofKind
    double factor[kForms];           // form = factor x values
    int slot;                        // of the product with d, or -1 where no load needs it
    int rate_slot;                   // of the product with d', or -1
    bool rates;                      // the product with d' is needed, if only for sums
    std::vector<double> values;      // [node][3 neighbours][column of the node][row of the node][copy]
  };
  std::vector<FormPart> parts;

  /// The entries of one kind of a linear form.
  struct LinePart {
    int kind;                        // DofKind
    int line;                        // BladeLine
    int slot;                        // or -1 where it is no load of the rotation
    std::vector<double> values;      // [row][copy]
  };
  std::vector<LinePart> lines;

  std::vector<double> hub_rows;                   // [modal entry][kHubRows][copy]: modal loads of unit hub accelerations, undeformed
  std::vector<double> hub_row_products;           // [kHubPairs][copy]: their sums of products over the modes
  /// A mast that twists accelerates the blades: b twist'' in each modal equation, b the hub row of a turn about the hub's axis. Modes slower than the
  /// mast (FeRotorParameters::absolute_below) have p = q + b twist as state, in effect their motion relative to the drive, as the lag rotor has in its
  /// absolute-lag form. Then they feel omega^2 b twist instead, a smaller force, and the mast's S can take the stiffness with which they hold it.
  bool absolute;                                  // there are such modes
  std::vector<double> twist_share;                // [modal entry][copy]: b, 0 where the state is q
  double twist_stiffness, twist_damping;          // sum of b^2 omega^2 [N m/rad] and of b^2 c [N m s/rad] over those modes of all blades

  std::vector<double> hinge_damping;              // [2][copy]: of the root slopes in v and in w
  std::vector<double> rigid;                      // [10][copy]: mass, first moment x y z, inertia xx yy zz xy xz yz
  double nominal_mean, nominal_spin, nominal_lead_v;  // contained in S: Omega^2 cos^2 p, Omega^2 sin^2 p and Omega^2 e0

  struct SectionShape {
    int node;                    // left end of the element
    double radius;               // [m]
    double v[4], slope[4];       // cubic Hermite: left value, left slope, right value, right slope
    double twist[2];             // linear
    double built_in_twist;       // [rad]
  };
  std::vector<SectionShape> shapes;  // sections, then the tip

  std::vector<std::string> state_names;  // [mode][blade], "L1_1"
};

}  // namespace heerk_rotor
