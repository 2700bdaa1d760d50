// The generalized-alpha method, the standard of structural dynamics, for a coupled system whose S has second-order or modal blocks.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <Eigen/LU>

#include "integration.hpp"
#include "right_hand_side.hpp"

namespace heerk_rotor::work_precision {
namespace {

constexpr int kMaxIterations = 40;
constexpr double kTolerance = 1e-10;  // of the last correction over the size of the unknown, far below the errors compared

/// Chung & Hulbert, J. Appl. Mech. 60 (1993) 371, for q'' = F(t, q, q'):  a at n + 1 - alpha_m equals F at n + 1 - alpha_f, with Newmark's
///   q_1 = q_0 + h v_0 + h^2 ((1/2 - beta) a_0 + beta a_1),   v_1 = v_0 + h ((1 - gamma) a_0 + gamma a_1);
/// Jansen, Whiting & Hulbert, Comput. Methods Appl. Mech. Eng. 190 (2000) 305, for states that are no second-order system:
///   x' at n + alpha_m' equals f at n + alpha_f',  x_1 = x_0 + h ((1 - gamma') x'_0 + gamma' x'_1);   alpha_f' = 1 - alpha_f.
/// Both are of order 2 with the spectral radius rho at infinite frequency. Unknowns a_1 and x'_1; modified Newton with the constant S, whose
/// factors are made once.
class GeneralizedAlpha final : public Integration {
 public:
  GeneralizedAlpha(const Problem& problem, const Problem::Overrides& overrides, double rho, double h)
      : problem_(problem), f_(problem, overrides), h_(h), alpha_m_((2.0 * rho - 1.0) / (rho + 1.0)), alpha_f_(rho / (rho + 1.0)), gamma_(0.5 - alpha_m_ + alpha_f_),
        beta_(0.25 * (1.0 - alpha_m_ + alpha_f_) * (1.0 - alpha_m_ + alpha_f_)), first_m_(0.5 * (3.0 - rho) / (1.0 + rho)), first_f_(1.0 - alpha_f_),
        first_gamma_(0.5 + first_m_ - first_f_) {
    for (const CoupledSystem::Subsystem& s : f_.system().subsystems())
      if (s.x_size > 0) addBlock(s.stiff, s.x_begin);
    const Index n = f_.size();
    for (Vector* v : {&x_, &rate_, &new_rate_, &middle_, &right_, &residual_}) v->setZero(n);
    states_.resize(n, problem.instants);
    stride_ = std::lround(problem.spacing() / h);
  }

  bool run() override {
    f_.restart();
    x_ = f_.start();
    steps_ = 0;
    if (!f_.complete(0.0, x_.data(), rate_.data())) return false;
    for (Index k = 0; k < problem_.instants; ++k) {
      for (long i = 0; i < stride_; ++i, ++steps_)
        if (!step(h_ * static_cast<double>(steps_))) return false;
      states_.col(k) = x_;
    }
    evaluations_ = f_.evaluations;
    return true;
  }

 private:
  /// One block of states; m > 0: q and v of a second-order system, m each.
  struct Block {
    Index begin, size, m;
    Eigen::ArrayXd diagonal;         // modal: inverse of the iteration matrix
    Eigen::PartialPivLU<Matrix> lu;  // otherwise; empty: no S, the matrix is first_m_ I
  };

  void addBlock(const StiffPart& part, Index begin) {
    const double stiff = (1.0 - alpha_f_) * beta_ * h_ * h_, damp = (1.0 - alpha_f_) * gamma_ * h_;
    if (const auto* modal = std::get_if<ModalStiff>(&part)) {
      const Index m = modal->omega.size();
      blocks_.push_back({begin, 2 * m, m, 1.0 / ((1.0 - alpha_m_) + damp * modal->damping.array() + stiff * modal->omega.array().square()), {}});
    } else if (const auto* second = std::get_if<SecondOrderStiff>(&part)) {
      const Index m = second->stiffness.rows();
      const Matrix A = (1.0 - alpha_m_) * Matrix::Identity(m, m) + damp * second->damping + stiff * second->stiffness;
      blocks_.push_back({begin, 2 * m, m, {}, A.partialPivLu()});
    } else if (const auto* list = std::get_if<BlockStiff>(&part)) {
      for (const StiffBlock& block : list->blocks) {
        addBlock(block.part, begin);
        begin += stiffSize(block.part);
      }
    } else {
      Block block{begin, stiffSize(part), 0, {}, {}};
      if (!std::holds_alternative<ZeroStiff>(part))
        block.lu = (first_m_ * Matrix::Identity(block.size, block.size) - first_f_ * first_gamma_ * h_ * stiffMatrix(part)).partialPivLu();
      blocks_.push_back(std::move(block));
    }
  }

  /// rate_ holds a (second-order blocks, at the places of q' as well as v') and x' (others).
  bool step(double t) noexcept {
    new_rate_ = rate_;
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      for (const Block& b : blocks_) stage(b);
      if (!f_.complete(t + first_f_ * h_, middle_.data(), right_.data())) return false;
      double correction = 0.0;
      for (const Block& b : blocks_) correction = std::max(correction, improve(b));
      if (!std::isfinite(correction)) return false;
      if (correction <= kTolerance) {
        for (const Block& b : blocks_) finish(b);
        rate_ = new_rate_;
        return true;
      }
    }
    return false;
  }

  void stage(const Block& b) noexcept {
    const double part = first_f_;
    if (b.m == 0) {
      const auto x = x_.segment(b.begin, b.size), rate = rate_.segment(b.begin, b.size), new_rate = new_rate_.segment(b.begin, b.size);
      middle_.segment(b.begin, b.size) = x + part * h_ * ((1.0 - first_gamma_) * rate + first_gamma_ * new_rate);
      return;
    }
    const auto q = x_.segment(b.begin, b.m), v = x_.segment(b.begin + b.m, b.m), a = rate_.segment(b.begin + b.m, b.m), new_a = new_rate_.segment(b.begin + b.m, b.m);
    middle_.segment(b.begin, b.m) = q + part * (h_ * v + h_ * h_ * ((0.5 - beta_) * a + beta_ * new_a));
    middle_.segment(b.begin + b.m, b.m) = v + part * h_ * ((1.0 - gamma_) * a + gamma_ * new_a);
  }

  /// One correction; returns its size over that of the block's unknowns.
  double improve(const Block& b) noexcept {
    const Index begin = b.begin + b.m, size = b.size - b.m;
    const double now = b.m == 0 ? first_m_ : 1.0 - alpha_m_;
    auto residual = residual_.segment(begin, size);
    residual = right_.segment(begin, size) - (1.0 - now) * rate_.segment(begin, size) - now * new_rate_.segment(begin, size);
    if (b.diagonal.size() > 0) residual.array() *= b.diagonal;
    else if (b.lu.rows() > 0) residual = b.lu.solve(residual).eval();
    else residual /= now;
    new_rate_.segment(begin, size) += residual;
    const double scale = new_rate_.segment(begin, size).norm();
    return scale > 0.0 ? residual.norm() / std::max(scale, 1e-8) : 0.0;
  }

  void finish(const Block& b) noexcept {
    if (b.m == 0) {
      x_.segment(b.begin, b.size) += h_ * ((1.0 - first_gamma_) * rate_.segment(b.begin, b.size) + first_gamma_ * new_rate_.segment(b.begin, b.size));
      return;
    }
    auto q = x_.segment(b.begin, b.m), v = x_.segment(b.begin + b.m, b.m);
    const auto a = rate_.segment(b.begin + b.m, b.m), new_a = new_rate_.segment(b.begin + b.m, b.m);
    q += h_ * v + h_ * h_ * ((0.5 - beta_) * a + beta_ * new_a);
    v += h_ * ((1.0 - gamma_) * a + gamma_ * new_a);
  }

  Problem problem_;
  RightHandSide f_;
  double h_, alpha_m_, alpha_f_, gamma_, beta_, first_m_, first_f_, first_gamma_;
  std::vector<Block> blocks_;
  Vector x_, rate_, new_rate_, middle_, right_, residual_;
  long stride_;
};

}  // namespace

std::vector<Family> generalizedAlpha(const Problem& problem, bool quick) {
  std::vector<Family> families;
  const auto add = [&](double rho, const Problem::Overrides& overrides, const std::string& form) {
    std::ostringstream setting;
    setting << "rho = " << rho << (form.empty() ? "" : ", ") << form;
    families.push_back({"generalized-alpha", setting.str(), dividingSteps(problem, quick),
                        [=](double h) { return std::make_unique<GeneralizedAlpha>(problem, overrides, rho, h); }, overrides});
  };
  for (const double rho : {0.9, 0.6}) {
    if (quick && rho != 0.9) continue;
    add(rho, problem.newmark, problem.newmark.empty() ? "" : "modal coordinates, first order");
    if (!problem.second_order.empty()) add(rho, problem.second_order, "physical coordinates");
  }
  return families;
}

}  // namespace heerk_rotor::work_precision
