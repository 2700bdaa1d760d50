#pragma once
#include <Eigen/Core>

namespace heerk_rotor {

using Index = Eigen::Index;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Read-only and writable views of a contiguous piece of a vector that somebody else owns. What is given to a model lies in memory that Eigen has
/// aligned: the order in which its loops round depends on the address, and runs must repeat to the last bit.
using In = Eigen::Map<const Eigen::VectorXd>;
using Out = Eigen::Map<Eigen::VectorXd>;

inline In view(const Vector& v) { return In(v.data(), v.size()); }
inline Out view(Vector& v) { return Out(v.data(), v.size()); }

}  // namespace heerk_rotor
