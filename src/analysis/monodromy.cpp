#include "heerk_rotor/analysis/monodromy.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace heerk_rotor {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kNeutral = 1e-9;  // |ln mu| below it is difference noise about a motion that neither grows nor oscillates

/// What all threads of one gradient read, and the columns they write, each its own.
struct Differences {
  const Vector &x, &w;
  const std::vector<Index>& controls;
  const MapScales& scales;
  DifferenceOptions options;
  Vector reference;  // scaled result at (x, w)
  Matrix& columns;
  std::vector<char> good;

  Vector scaledResult(const Vector& end, const Vector& means) const {
    Vector result(end.size() + means.size());
    result << end.cwiseQuotient(scales.states), means.cwiseQuotient(scales.targets);
    return result;
  }

  /// Result with argument j moved by `move` scales; the move that rounding left is returned in its place.
  bool moved(RevolutionMap& map, Index j, double& move, Vector& result) const {
    Vector x1 = x, w1 = w, end, means;
    const Index n = x.size();
    double& argument = j < n ? x1[j] : w1[controls[static_cast<std::size_t>(j - n)]];
    const double scale = j < n ? scales.states[j] : scales.controls[j - n], before = argument;
    argument += move * scale;
    move = (argument - before) / scale;
    if (!map.evaluate(x1, w1, end, means)) return false;
    result = scaledResult(end, means);
    return true;
  }

  void column(RevolutionMap& map, Index j) {
    double up = options.width, down = 0.0;
    const Index n = x.size();
    if (j >= n) {
      const Index control = controls[static_cast<std::size_t>(j - n)];
      if (w[control] + up * scales.controls[j - n] > map.system().commandHigh()[control]) up = -up;  // beyond it the model clamps
    }
    Vector result, other = reference;
    const bool central = options.central && j < n;
    if (central) down = -options.width;
    bool done = moved(map, j, up, result);
    if (done && central) done = moved(map, j, down, other);
    if (done) columns.col(j) = (result - other) / (up - down);
    good[static_cast<std::size_t>(j)] = done;
  }
};

}  // namespace

MapGradient differenceMap(const MapTeam& maps, const Vector& x, const Vector& w, const std::vector<Index>& controls, const MapScales& scales,
                          const DifferenceOptions& options) {
  MapGradient gradient;
  const Index columns = x.size() + static_cast<Index>(controls.size());
  gradient.scaled = Matrix::Zero(x.size() + static_cast<Index>(maps.front()->signals().size()), columns);
  const auto spent = [&maps] {
    long sum = 0;
    for (const auto& map : maps) sum += map->revolutions();
    return sum;
  };
  const long before = spent();
  Differences differences{x, w, controls, scales, options, {}, gradient.scaled, std::vector<char>(static_cast<std::size_t>(columns), 0)};
  Vector end, means;
  if (!maps.front()->evaluate(x, w, end, means)) return gradient;
  differences.reference = differences.scaledResult(end, means);

  // Columns are dealt out by number, and each depends on its own perturbation only.
  const auto work = [&](std::size_t member) {
    for (Index j = static_cast<Index>(member); j < columns; j += static_cast<Index>(maps.size())) differences.column(*maps[member], j);
  };
  std::vector<std::thread> threads;
  for (std::size_t member = 1; member < maps.size(); ++member) threads.emplace_back(work, member);
  work(0);
  for (std::thread& thread : threads) thread.join();
  gradient.revolutions = spent() - before;
  gradient.complete = std::all_of(differences.good.begin(), differences.good.end(), [](char good) { return good != 0; });
  return gradient;
}

std::vector<Multiplier> multipliers(const Matrix& map, double dt, const std::vector<std::string>& state_names) {
  std::vector<Multiplier> result;
  if (map.rows() == 0) return result;
  const Eigen::EigenSolver<Matrix> solver(map);
  const Eigen::MatrixXcd right = solver.eigenvectors();
  const Eigen::MatrixXcd left = right.inverse();           // rows; not finite where eigenvectors coincide
  for (Index k = 0; k < map.rows(); ++k) {
    Multiplier one;
    one.mu = solver.eigenvalues()[k];
    if (one.mu.imag() < 0.0) continue;
    const double modulus = std::abs(one.mu);
    if (modulus > 0.0) {
      const std::complex<double> s = std::log(one.mu) / dt;
      one.frequency = std::abs(s.imag()) / (2.0 * kPi);
      one.damping_ratio = std::abs(s) * dt > kNeutral ? -s.real() / std::abs(s) : 0.0;
    } else {
      one.damping_ratio = 1.0;
    }
    double largest = -1.0;
    for (Index i = 0; i < map.rows(); ++i) {
      double participation = std::abs(right(i, k) * left(k, i));
      if (!std::isfinite(participation)) participation = std::abs(right(i, k));
      if (!(participation > largest * (1.0 + 1e-6))) continue;  // the first of equals (blades), whatever the round-off
      largest = participation;
      one.state = state_names[static_cast<std::size_t>(i)];
    }
    result.push_back(one);
  }
  std::stable_sort(result.begin(), result.end(), [](const Multiplier& a, const Multiplier& b) { return std::abs(a.mu) > std::abs(b.mu); });
  return result;
}

}  // namespace heerk_rotor
