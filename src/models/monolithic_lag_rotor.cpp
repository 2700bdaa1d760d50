#include "heerk_rotor/models/monolithic_lag_rotor.hpp"

#include <cmath>

namespace heerk_rotor {

MonolithicLagRotor::MonolithicLagRotor(const Parameters& parameters) : p_(parameters) {
  const LagRotorParameters& r = p_.rotor;
  const double a = r.hinge_offset, b = r.blade_length, m = r.blade_mass, i_zb = r.blade_inertia;
  const double inertia = 4.0 * (a + b) * (a + b) * m + 4.0 * i_zb;
  r_m_ = m * b / (r.fuselage_mass_x + 4.0 * m);
  r_b_ = m * b / (m * b * b + i_zb);
  r_a2_ = a * r_b_;
  r_sb_ = (b * (a + b) * m + i_zb) / inertia;
  omega_s2_ = p_.mast_stiffness / inertia;
}

std::vector<State> MonolithicLagRotor::states() const {
  std::vector<State> list{{"fuselage_x", "m", "fuselage displacement, aft positive"}, {"fuselage_y", "m", "fuselage displacement, to starboard positive"}};
  for (int i = 1; i <= kLagBlades; ++i) list.push_back({"lag_" + std::to_string(i), "rad", "lag angle, lead positive"});
  list.push_back({"twist", "rad", "hub angle minus Omega t"});
  for (std::size_t i = 0; i < 7; ++i) {
    State rate = list[i];
    const auto digit = rate.name.find("lag_");
    rate.name = digit == 0 ? "lag_rate_" + rate.name.substr(4) : rate.name + "_rate";
    rate.unit += "/s";
    rate.meaning = "rate of the " + rate.meaning;
    list.push_back(rate);
  }
  return list;
}

std::vector<OutputPort> MonolithicLagRotor::outputs() const {
  return {{"lag", kLagBlades, "rad", "lag angle of each blade, lead positive", {}, 0.01, {}, true},
          {"azimuth", 1, "rad", "hub angle, unwrapped", {}, 1.0, {}, false}};
}

/// M_mon of A.2, in the order (x, y, phi_1..4, hub angle).
MonolithicLagRotor::Matrix7 MonolithicLagRotor::massMatrix(double azimuth, const double* lag) const noexcept {
  const double s = std::sin(azimuth), c = std::cos(azimuth);
  const double sine[4] = {s, c, -s, -c}, cosine[4] = {c, -s, -c, s};
  Matrix7 m = Matrix7::Identity();
  for (int i = 0; i < 4; ++i) {
    m(0, 2 + i) = -r_m_ * sine[i];
    m(1, 2 + i) = r_m_ * cosine[i];
    m(2 + i, 0) = -r_b_ * sine[i];
    m(2 + i, 1) = r_b_ * cosine[i];
    m(2 + i, 6) = r_a2_ + 1.0;
    m(6, 2 + i) = r_sb_;
  }
  m(0, 6) = -r_m_ * ((lag[0] - lag[2]) * c - s * (lag[1] - lag[3]));
  m(1, 6) = -r_m_ * ((lag[1] - lag[3]) * c + s * (lag[0] - lag[2]));
  return m;
}

StiffPart MonolithicLagRotor::stiffPart() const {
  if (p_.linear_part == LinearPart::kZero) return ZeroStiff{14};
  Vector7 column;
  if (p_.linear_part == LinearPart::kPaper) {
    column << 0.0, 0.0, 705.0, 705.0, 705.0, 705.0, -680.0;
  } else {
    column = -massMatrix(0.0, p_.reference_lag.data()).partialPivLu().solve(Vector7::Unit(6));
  }
  DenseStiff part{Matrix::Zero(14, 14)};
  part.S.topRightCorner(7, 7).setIdentity();
  part.S.block(7, 6, 7, 1) = omega_s2_ * column;
  return part;
}

void MonolithicLagRotor::evalOutput(Index port, double t, const In& x, const In&, Out y) noexcept {
  if (port == 0) y = x.segment(2, kLagBlades);
  else y[0] = p_.rotor_speed * t + x[6];
}

void MonolithicLagRotor::evalDerivatives(double t, const In& x, const In&, Out xdot) noexcept {
  const double azimuth = p_.rotor_speed * t + x[6], omega = p_.rotor_speed + x[13];
  const double s = std::sin(azimuth), c = std::cos(azimuth);
  const double* lag = x.data() + 2;
  const double* rate = x.data() + 9;
  const double lag24 = lag[1] - lag[3], lag31 = lag[2] - lag[0];
  const double first = lag24 * omega - 2.0 * rate[0] + 2.0 * rate[2], second = lag31 * omega - 2.0 * rate[1] + 2.0 * rate[3];
  const LagRotorParameters& r = p_.rotor;

  Vector7 rhs;  // F_mon - K_mon u
  rhs[0] = -r_m_ * (first * c - second * s) * omega - r.fuselage_frequency_x * r.fuselage_frequency_x * x[0];
  rhs[1] = -r_m_ * (second * c + first * s) * omega - r.fuselage_frequency_y * r.fuselage_frequency_y * x[1];
  for (int i = 0; i < 4; ++i) rhs[2 + i] = -(r_a2_ * omega * omega + r.lag_frequency[i] * r.lag_frequency[i]) * lag[i];
  rhs[6] = -omega_s2_ * x[6];
  const Vector7 acceleration = massMatrix(azimuth, lag).partialPivLu().solve(rhs);
  xdot.head(7) = x.tail(7);
  xdot.tail(7) = acceleration;
}

}  // namespace heerk_rotor
