// What generality costs: a step through the coupled system (ports, loops, any model) against a step written by hand for one problem alone, in the same
// run. The hand-written steps know everything beforehand: sizes, couplings, which weights of HEERK4 vanish, and that no damper, airload or drive acts.
// They have no ports, no loop over subsystems, no virtual call, no check and no solver. Before it is timed, each follows the general simulation over
// 1000 steps; `difference` is the largest difference of a state then, relative to the largest of its kind.
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "heerk_rotor/core/branch_free_math.hpp"
#include "heerk_rotor/integrate/linear_propagator.hpp"
#include "heerk_rotor/models/lag_rotor_parameters.hpp"
#include "heerk_rotor/shaft/squeeze_film.hpp"
#include "step_benchmark.hpp"

namespace heerk_rotor {
namespace {

constexpr int kHalf = 1, kWhole = 3, kNext = 5;  // rows of HEERK4 that end at h/2, at h, and with the next state; its nodes are 0, 1/2, 1/2, 1, 1/2

/// Rows of HEERK4 for one S as matrices.
class Rows {
 public:
  Rows(const StiffPart& S, double h) : size_(stiffSize(S)), propagator_(makePropagator(S, h, tableau("HEERK4"))) {}

  /// e^{c_row hS}
  Matrix state(int row) const {
    Matrix result(size_, size_);
    for (Index k = 0; k < size_; ++k) {
      const Vector unit = Vector::Unit(size_, k);
      propagator_->propagate(row, unit.data(), result.col(k).data());
    }
    return result;
  }

  /// h a_{row, stage}(hS) B
  Matrix remainder(int row, int stage, const Matrix& B) const {
    Matrix result(size_, B.cols());
    const Vector zero = Vector::Zero(size_);
    for (Index k = 0; k < B.cols(); ++k) {
      Matrix remainders = Matrix::Zero(size_, kNext);
      remainders.col(stage) = B.col(k);
      propagator_->combine(row, zero.data(), remainders.data(), size_, result.col(k).data());
    }
    return result;
  }

 private:
  Index size_;
  std::unique_ptr<LinearPropagator> propagator_;
};

const CoupledSystem::Subsystem& subsystem(const Simulation& simulation, const std::string& name) {
  for (const CoupledSystem::Subsystem& s : simulation.system().subsystems())
    if (s.name == name) return s;
  throw std::out_of_range(name);
}

/// Lag rotor with absolute lag angles: four equal blades without damper or airload, fuselage and mast without damping, drive at nominal speed. Such
/// blades split into collective and differential lag, which do not feel the fuselage, and the two pairs of opposite blades, which do. So collective
/// lag and mast go through all stages first, then come the sines and cosines of all stages at once, then fuselage and pairs.
/// With S = 0 HEERK4 is the classical method a21 = a32 = a42 = a43 = 1/2, a51 = 1/4, a52 = a53 = 1/8, b1 = b4 = 1/6, b5 = 2/3; for q'' = f a rate of
/// one stage is put into the displacement of the next: q5 = q + h q'/2 + h^2/16 (f1 + f2), q_next = q + h q' + h^2/6 (f1 + f2 + f3).
class LagRotorByHand {
 public:
  explicit LagRotorByHand(const Simulation& simulation) : h_(simulation.stepSize()), step_(simulation.stepCount()) {
    const LagRotorParameters p;  // as config/lag_rotor.yaml has them
    const LagRotorConstants c(p);
    const CoupledSystem::Subsystem& mast = subsystem(simulation, "mast");
    const MastLoad load = mastLoad(p, LagFormulation::kAbsoluteLag, kSpeed);
    const double omega = std::get<ModalStiff>(mast.stiff).omega[0];
    mast_stiffness_ = omega * omega;
    reaction_ = kLagBlades * c.coupling_inertia / load.inertia;
    g_ = c.g;
    r_a2_ = c.r_a2;
    r_b_ = c.r_b;
    nominal_ = r_a2_ * kSpeed * kSpeed + p.lag_frequency[0] * p.lag_frequency[0];
    const double share_x = 1.0 / (1.0 - 2.0 * c.r_mx * c.r_b), share_y = 1.0 / (1.0 - 2.0 * c.r_my * c.r_b);
    stiffness_x_ = share_x * p.fuselage_frequency_x * p.fuselage_frequency_x;
    stiffness_y_ = share_y * p.fuselage_frequency_y * p.fuselage_frequency_y;
    blades_x_ = 2.0 * c.r_mx * share_x;
    blades_y_ = 2.0 * c.r_my * share_y;

    const Rows rows(mast.stiff, h_);
    const Matrix acceleration = Vector::Unit(2, 1);
    const auto pair = [&](int row, int stage) { return Pair(rows.remainder(row, stage, acceleration)); };
    half_ = rows.state(kHalf);
    whole_ = rows.state(kWhole);
    a21_ = pair(1, 0), a31_ = pair(2, 0), a32_ = pair(2, 1), a41_ = pair(3, 0), a42_ = pair(3, 1), a51_ = pair(4, 0), a52_ = pair(4, 1), a54_ = pair(4, 3);
    b1_ = pair(kNext, 0), b4_ = pair(kNext, 3), b5_ = pair(kNext, 4);

    const Vector& x = simulation.state();
    const double* lag = x.data() + 2;
    const double* rate = x.data() + 8;
    const auto collective = [](const double* v) { return 0.25 * ((v[0] + v[2]) + (v[1] + v[3])); };
    const auto differential = [](const double* v) { return 0.25 * ((v[0] + v[2]) - (v[1] + v[3])); };
    collective_ = collective(lag), collective_rate_ = collective(rate);
    differential_ = differential(lag), differential_rate_ = differential(rate);
    q_ << x[0], x[1], 0.5 * (lag[0] - lag[2]), 0.5 * (lag[1] - lag[3]);
    v_ << x[6], x[7], 0.5 * (rate[0] - rate[2]), 0.5 * (rate[1] - rate[3]);
    mast_ << x[12], x[13];
  }

  void step() noexcept;

  /// The states in the order of the simulation, kinds together: fuselage, lag, their rates, twist, its rate.
  Vector state() const {
    Vector x(14);
    const auto blades = [](double collective, double differential, const Four& pairs, double* lag) {
      lag[0] = collective + differential + pairs[2];
      lag[1] = collective - differential + pairs[3];
      lag[2] = collective + differential - pairs[2];
      lag[3] = collective - differential - pairs[3];
    };
    x[0] = q_[0], x[1] = q_[1], x[6] = v_[0], x[7] = v_[1];
    blades(collective_, differential_, q_, x.data() + 2);
    blades(collective_rate_, differential_rate_, v_, x.data() + 8);
    x.tail(2) = mast_;
    return x;
  }
  static std::vector<int> kinds() { return {0, 0, 1, 1, 1, 1, 2, 2, 3, 3, 3, 3, 4, 5}; }

 private:
  static constexpr double kSpeed = 6.63;  // Omega of config/lag_rotor.yaml [rad/s]
  static constexpr int kStages = 5;
  using Pair = Eigen::Vector2d;
  using Four = Eigen::Array4d;

  double h_;
  double g_, r_a2_, r_b_;                                   // as LagRotorConstants
  double nominal_;                                          // k at nominal speed [1/s^2]
  double mast_stiffness_, reaction_;                        // of S; 4 S_h; both over the mast's inertia
  double stiffness_x_, stiffness_y_, blades_x_, blades_y_;  // of the fuselage's rows, blade accelerations eliminated
  Eigen::Matrix2d half_, whole_;                            // e^{hS/2}, e^{hS}
  Pair a21_, a31_, a32_, a41_, a42_, a51_, a52_, a54_, b1_, b4_, b5_;

  std::uint64_t step_;
  double collective_, collective_rate_, differential_, differential_rate_;
  Four q_, v_;  // fuselage x, y, half the difference of blades 1 and 3, of 2 and 4; their rates
  Pair mast_;   // twist and its rate
};

inline void LagRotorByHand::step() noexcept {
  const double h = h_, h2 = h * h;
  double angle[kStages], speed[kStages], k[kStages], alpha[kStages];  // of the hub; k: stiffness of a blade over its inertia
  double f_collective[kStages], f_differential[kStages];

  // Collective and differential lag, and the mast with what the blades exert on it.
  const auto turn = [&](int i, const Pair& mast, double collective, double differential) {
    const double twist = mast[0], rate = mast[1], follows = g_ * twist;
    speed[i] = kSpeed + rate;
    const double excess = rate * (speed[i] + kSpeed);  // omega^2 - Omega^2
    const double reaction = reaction_ * nominal_ * collective + excess * (reaction_ * r_a2_ * (collective - follows));
    k[i] = nominal_ + r_a2_ * excess;
    angle[i] = twist;
    alpha[i] = reaction - mast_stiffness_ * twist;
    f_collective[i] = k[i] * (follows - collective);
    f_differential[i] = -k[i] * differential;
    return reaction;
  };
  const auto firstTwo = [](const double* f) { return f[0] + f[1]; };
  const double c2 = collective_ + 0.5 * h * collective_rate_, c4 = collective_ + h * collective_rate_;
  const double d2 = differential_ + 0.5 * h * differential_rate_, d4 = differential_ + h * differential_rate_;
  const double *fc = f_collective, *fd = f_differential;
  const Pair at_half = half_ * mast_, at_whole = whole_ * mast_;
  const double r1 = turn(0, mast_, collective_, differential_);
  const double r2 = turn(1, at_half + a21_ * r1, c2, d2);
  const double r3 = turn(2, at_half + a31_ * r1 + a32_ * r2, c2 + 0.25 * h2 * fc[0], d2 + 0.25 * h2 * fd[0]);
  const double r4 = turn(3, at_whole + a41_ * r1 + a42_ * (r2 + r3), c4 + 0.25 * h2 * firstTwo(fc), d4 + 0.25 * h2 * firstTwo(fd));
  const double r5 = turn(4, at_half + a51_ * r1 + a52_ * (r2 + r3) + a54_ * r4, c2 + 0.0625 * h2 * firstTwo(fc), d2 + 0.0625 * h2 * firstTwo(fd));
  mast_ = at_whole + b1_ * r1 + b4_ * r4 + b5_ * r5;
  collective_ = c4 + h2 / 6.0 * (firstTwo(fc) + fc[2]);
  differential_ = d4 + h2 / 6.0 * (firstTwo(fd) + fd[2]);
  collective_rate_ += h / 6.0 * (fc[0] + fc[3] + 4.0 * fc[4]);
  differential_rate_ += h / 6.0 * (fd[0] + fd[3] + 4.0 * fd[4]);

  // Where the blades are: the first stage apart, because four fill a vector.
  const double start = kSpeed * (static_cast<double>(step_++) * h), middle = start + 0.5 * kSpeed * h, end = start + kSpeed * h;
  double sine[kStages], cosine[kStages];
  const auto place = [&](int i) {
    const SineCosine of = sineCosine(angle[i]);
    sine[i] = of.sine;
    cosine[i] = of.cosine;
  };
  angle[0] += start;
  angle[1] += middle;
  angle[2] += middle;
  angle[3] += end;
  angle[4] += middle;
  place(0);
  for (int i = 1; i < kStages; ++i) place(i);

  // Fuselage and pairs of opposite blades.
  const auto accelerations = [&](int i, const Four& q, const Four& v) {
    const double s = sine[i], c = cosine[i], k_fixed = k[i] + speed[i] * speed[i], coriolis = 2.0 * speed[i];
    const double along = alpha[i] * c - k_fixed * s, across = alpha[i] * s + k_fixed * c;
    const double x = blades_x_ * ((along * q[2] - across * q[3]) + coriolis * (c * v[2] - s * v[3])) - stiffness_x_ * q[0];
    const double y = blades_y_ * ((across * q[2] + along * q[3]) + coriolis * (s * v[2] + c * v[3])) - stiffness_y_ * q[1];
    return Four(x, y, r_b_ * (s * x - c * y) - k[i] * q[2], r_b_ * (c * x + s * y) - k[i] * q[3]);
  };
  const Four q = q_, v = v_, q2 = q + 0.5 * h * v, q4 = q + h * v;
  const Four f1 = accelerations(0, q, v);
  const Four f2 = accelerations(1, q2, v + 0.5 * h * f1);
  const Four f3 = accelerations(2, q2 + 0.25 * h2 * f1, v + 0.5 * h * f2);
  const Four f4 = accelerations(3, q4 + 0.25 * h2 * (f1 + f2), v + 0.5 * h * (f2 + f3));
  const Four f5 = accelerations(4, q2 + 0.0625 * h2 * (f1 + f2), v + h * (0.25 * f1 + 0.125 * (f2 + f3)));
  q_ = q4 + h2 / 6.0 * (f1 + f2 + f3);
  v_ = v + h / 6.0 * (f1 + f4 + 4.0 * f5);
}

/// Dual-disc rotor: the shaft by its 37 pairs of S, of which the stages need the journal's motion C x alone. All states are moved once, at the end;
/// the journal's motion there comes with it and begins the next step.
class DualDiscByHand {
 public:
  explicit DualDiscByHand(const Simulation& simulation) : film_({kClearance, 0.011, 0.0675, 0.02, false}) {
    const CoupledSystem::Subsystem& shaft = subsystem(simulation, "shaft");
    Matrix C = shaft.model->narrowForm()->C;
    C.topRows(2) /= kClearance;
    const Matrix& B = shaft.model->narrowForm()->B;
    const Rows rows(shaft.stiff, simulation.stepSize());
    const Matrix whole = rows.state(kWhole);
    const Matrix CE[2] = {C * rows.state(kHalf), C * whole};
    for (Index k = 0; k < kStates; ++k)
      for (int r = 0; r < 8; ++r) free_[place(k) / 4][r][place(k) % 4] = CE[r / 4](r % 4, k);
    for (int i = 0; i < kPairs; ++i) {
      qq_[i] = whole(i, i);
      qv_[i] = whole(i, kPairs + i);
      vq_[i] = whole(kPairs + i, i);
      vv_[i] = whole(kPairs + i, kPairs + i);
    }
    const auto weight = [&](int row, int stage) { return Narrow(C * rows.remainder(row, stage, B)); };
    a21_ = weight(1, 0), a31_ = weight(2, 0), a32_ = weight(2, 1), a41_ = weight(3, 0), a42_ = weight(3, 1);
    a51_ = weight(4, 0), a52_ = weight(4, 1), a54_ = weight(4, 3);
    b1_ = weight(kNext, 0), b4_ = weight(kNext, 3), b5_ = weight(kNext, 4);
    for (int j : {0, 1, 2}) {
      const Matrix column = rows.remainder(kNext, j == 0 ? 0 : j + 2, B);
      for (Index k = 0; k < kStates; ++k)
        for (int axis : {0, 1}) next_[place(k) / 4][2 * j + axis][place(k) % 4] = column(k, axis);
    }
    for (Index k = 0; k < kStates; ++k) x_[place(k)] = simulation.state()[k];
    z_ = C * simulation.state();
  }

  void step() noexcept;

  Vector state() const {
    Vector x(kStates);
    for (Index k = 0; k < kStates; ++k) x[k] = x_[place(k)];
    return x;
  }
  /// Modes, and the phasor of the unbalance.
  static std::vector<int> kinds() {
    std::vector<int> result(kStates, 0);
    result[kPairs - 1] = result[kStates - 1] = 1;
    return result;
  }

 private:
  static constexpr double kClearance = 1.6e-4, kStaticEccentricityY = -0.2, kDampingInS = 1034.0;
  static constexpr int kPairs = 37, kStates = 2 * kPairs, kPitch = 40, kBlocks = 2 * kPitch / 4;
  using Four = Eigen::Array4d;
  using Narrow = Eigen::Matrix<double, 4, 2>;

  static constexpr Index place(Index state) { return state < kPairs ? state : state - kPairs + kPitch; }
  static Four load(const double* from) { return Eigen::Map<const Four, Eigen::Aligned32>(from); }
  SqueezeFilm::Force force(const Four& z) const noexcept {
    const SqueezeFilm::Force f = film_.force(z[0], kStaticEccentricityY + z[1], z[2], z[3]);
    return {f.x + kDampingInS * z[2], f.y + kDampingInS * z[3]};
  }

  alignas(64) double x_[2 * kPitch] = {};        // first coordinates of the pairs, then second ones, each padded
  alignas(64) double free_[kBlocks][8][4] = {};  // C e^{hS/2}, C e^{hS} by blocks of four states
  alignas(64) double next_[kBlocks][6][4] = {};  // what the force of stages 1, 4, 5 does to the next state
  alignas(64) double qq_[kPitch] = {}, qv_[kPitch] = {}, vq_[kPitch] = {}, vv_[kPitch] = {};  // e^{hS}
  Narrow a21_, a31_, a32_, a41_, a42_, a51_, a52_, a54_, b1_, b4_, b5_;
  Four z_;                                       // journal: parts of the clearance, and velocity [m/s]
  SqueezeFilm film_;
};

inline void DualDiscByHand::step() noexcept {
  const auto push = [](const Narrow& weight, const SqueezeFilm::Force& f) { return Four(weight.col(0).array() * f.x + weight.col(1).array() * f.y); };
  const auto sum = [](const SqueezeFilm::Force& a, const SqueezeFilm::Force& b) { return SqueezeFilm::Force{a.x + b.x, a.y + b.y}; };

  const SqueezeFilm::Force f1 = force(z_);
  Four sums[8];
  for (Four& s : sums) s.setZero();
  for (int block = 0; block < kBlocks; ++block) {
    const Four x = load(x_ + 4 * block);
    for (int r = 0; r < 8; ++r) sums[r] += load(free_[block][r]) * x;
  }
  const Four half(sums[0].sum(), sums[1].sum(), sums[2].sum(), sums[3].sum()), whole(sums[4].sum(), sums[5].sum(), sums[6].sum(), sums[7].sum());

  const SqueezeFilm::Force f2 = force(half + push(a21_, f1));
  const SqueezeFilm::Force f3 = force(half + push(a31_, f1) + push(a32_, f2));
  const SqueezeFilm::Force f23 = sum(f2, f3);
  const SqueezeFilm::Force f4 = force(whole + push(a41_, f1) + push(a42_, f23));
  const SqueezeFilm::Force f5 = force(half + push(a51_, f1) + push(a52_, f23) + push(a54_, f4));
  z_ = whole + push(b1_, f1) + push(b4_, f4) + push(b5_, f5);

  const auto forced = [&](int block) {
    const auto& b = next_[block];
    return Four((load(b[0]) * f1.x + load(b[1]) * f1.y) + (load(b[2]) * f4.x + load(b[3]) * f4.y) + (load(b[4]) * f5.x + load(b[5]) * f5.y));
  };
  for (int i = 0; i < kPitch; i += 4) {
    const Four q = load(x_ + i), v = load(x_ + kPitch + i);
    const Four q_next = load(qq_ + i) * q + load(qv_ + i) * v + forced(i / 4);
    const Four v_next = load(vq_ + i) * q + load(vv_ + i) * v + forced((kPitch + i) / 4);
    Eigen::Map<Four, Eigen::Aligned32>{x_ + i} = q_next;
    Eigen::Map<Four, Eigen::Aligned32>{x_ + kPitch + i} = v_next;
  }
}

/// Largest difference relative to the largest state of its kind.
double largestDifference(const Vector& general, const Vector& by_hand, const std::vector<int>& kinds) {
  if (!by_hand.allFinite()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (int kind = 0; kind <= *std::max_element(kinds.begin(), kinds.end()); ++kind) {
    double difference = 0.0, size = 0.0;
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (kinds[i] != kind) continue;
      const auto at = static_cast<Index>(i);
      difference = std::max(difference, std::abs(general[at] - by_hand[at]));
      size = std::max(size, std::abs(general[at]));
    }
    largest = std::max(largest, difference / size);
  }
  return largest;
}

void general(benchmark::State& state, const std::string& config, const std::vector<std::string>& overrides) { step(state, config, overrides); }

template <class ByHand>
void handWritten(benchmark::State& state, const std::string& config, const std::vector<std::string>& overrides) {
  constexpr int kWarmUp = 1000, kLength = 20000;  // as the general one
  constexpr double kTolerance = 1e-10;
  const auto simulation = make(config, overrides);
  const Vector command = simulation->system().defaultCommand();
  for (int k = 0; k < kWarmUp; ++k) simulation->step(command);
  ByHand by_hand(*simulation);
  const ByHand start = by_hand;
  for (int k = 0; k < 1000; ++k) {
    simulation->step(command);
    by_hand.step();
  }
  const double difference = largestDifference(simulation->state(), by_hand.state(), ByHand::kinds());
  if (!(difference <= kTolerance)) return state.SkipWithError(("differs from the general system by " + std::to_string(difference * 1e10) + "e-10").c_str());

  int steps = 0;
  by_hand = start;
  ShortestStretch stretch(400);
  for (auto _ : state) {
    by_hand.step();
    benchmark::DoNotOptimize(&by_hand);
    benchmark::ClobberMemory();
    stretch.step();
    if (++steps == kLength) {
      steps = 0;
      by_hand = start;
    }
  }
  state.counters["difference"] = difference;
  if (std::isfinite(stretch.microsecondsPerStep())) state.counters["shortest_us"] = stretch.microsecondsPerStep();
}

constexpr auto lagRotorByHand = handWritten<LagRotorByHand>;
constexpr auto dualDiscByHand = handWritten<DualDiscByHand>;

std::vector<std::string> mast(const std::string& stiffness) { return {"simulation.integrator=HEERK4", "simulation.step=1e-3", "subsystems.mast.stiffness=" + stiffness}; }
const std::vector<std::string> kDualDisc = {"simulation.integrator=HEERK4", "simulation.step=1e-5"};

BENCHMARK_CAPTURE(general, lag_rotor_3e4, "lag_rotor.yaml", mast("3e4"));
BENCHMARK_CAPTURE(lagRotorByHand, 3e4, "lag_rotor.yaml", mast("3e4"))->Name("hand_written/lag_rotor_3e4");
BENCHMARK_CAPTURE(general, lag_rotor_3e6, "lag_rotor.yaml", mast("3e6"));
BENCHMARK_CAPTURE(lagRotorByHand, 3e6, "lag_rotor.yaml", mast("3e6"))->Name("hand_written/lag_rotor_3e6");
BENCHMARK_CAPTURE(general, lag_rotor_3e8, "lag_rotor.yaml", mast("3e8"));
BENCHMARK_CAPTURE(lagRotorByHand, 3e8, "lag_rotor.yaml", mast("3e8"))->Name("hand_written/lag_rotor_3e8");
BENCHMARK_CAPTURE(general, dual_disc, "dual_disc.yaml", kDualDisc);
BENCHMARK_CAPTURE(dualDiscByHand, dual_disc, "dual_disc.yaml", kDualDisc)->Name("hand_written/dual_disc");

}  // namespace
}  // namespace heerk_rotor
