#pragma once
#include <string>

#include "heerk_rotor/analysis/coupling_report.hpp"

namespace heerk_rotor {

/// An SVG picture of the coupling. Left the subsystems along the diagonal of an N-squared chart, in the order of the
/// configuration: an output leaves its subsystem along the row and enters another along the column, the cell names the ports;
/// what belongs to an algebraic loop is red. Right the sparsity of I - dg/dy with all entries of the loops, pruned, and of L + U.
std::string couplingPicture(const CoupledSystem& system, const Coupling& coupling);

}  // namespace heerk_rotor
