#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "heerk_rotor/beam/blade_elements.hpp"

#include "blade_data.hpp"

namespace heerk_rotor {
namespace {

// Independent derivation of everything inertial: each cross section is four particles with the right mass, static moment and radii of
// gyration, carried by the exact rotation beta + phi. Stiffness and loads are derivatives of the centrifugal potential, the mass matrix
// is that of the particle velocities. Only the shape functions are shared with the library (they have tests of their own).
// Left out as in the formulation: bending rotary inertia, the square of the axial displacement by section tilt.

struct Field {
  BeamReal v, w, twist, slope_v, slope_w;
};

struct Particle {
  BeamReal dm, eta, zeta;  // chordwise, normal to the chord [m]
};

struct Slice {
  BeamReal x, tension, dx, twist;
  std::vector<Particle> particles;
  BeamMatrix rows;

  Field at(const BeamVector& q) const {
    const BeamVector y = rows * q;
    return {y[kRowV], y[kRowW], y[kRowTwist], y[kRowSlopeV], y[kRowSlopeW]};
  }
};

BladeProperties skewBlade() {
  BladeProperties p;
  p.nodes = {0.3, 0.8, 1.5, 2.0};
  p.stations = {0.3, 1.0, 2.0};
  p.mass = {4.0, 2.0, 1.0};
  p.EI_flap = {50};
  p.EI_lag = {400};
  p.GJ = {30};
  p.km1 = {0.02, 0.03, 0.01};
  p.km2 = {0.09, 0.07, 0.08};
  p.e = {0.03, -0.02, 0.04};
  p.twist = {0.3, 0.1, -0.2};
  p.root_lead = 0.05;
  p.tip_mass = 0.4;
  p.root.lag_hinge = true;
  return p;
}

/// Five-point Gauss quadrature on eight panels between breaks.
std::vector<Slice> slices(const BladeProperties& p, const BladeMatrices& blade) {
  const BeamReal inner = std::sqrt(5 - 2 * std::sqrt(BeamReal(10) / 7)) / 3, outer = std::sqrt(5 + 2 * std::sqrt(BeamReal(10) / 7)) / 3;
  const BeamReal inner_weight = (322 + 13 * std::sqrt(BeamReal(70))) / 900, outer_weight = (322 - 13 * std::sqrt(BeamReal(70))) / 900;
  const BeamReal node[] = {-outer, -inner, 0, inner, outer};
  const BeamReal weight[] = {outer_weight, inner_weight, BeamReal(128) / 225, inner_weight, outer_weight};
  const double breaks[] = {0.3, 0.8, 1.0, 1.5, 2.0};
  constexpr int kPanels = 8;

  std::vector<Slice> all;
  for (int i = 0; i < 4; ++i)
    for (int panel = 0; panel < kPanels; ++panel)
      for (int k = 0; k < 5; ++k) {
        const BeamReal width = (breaks[i + 1] - breaks[i]) / BeamReal(kPanels);
        Slice slice;
        slice.x = breaks[i] + width * (panel + (1 + node[k]) / 2);
        slice.dx = width * weight[k] / 2;
        const BladeSection s = bladeSection(p, slice.x);
        slice.twist = s.twist;
        slice.rows = blade.shapeRows(static_cast<double>(slice.x));
        const BeamReal half_chord = std::sqrt(s.km2 * s.km2 - s.e * s.e);
        for (int a : {-1, 1})
          for (int b : {-1, 1}) slice.particles.push_back({s.mass * slice.dx / 4, s.e + a * half_chord, b * s.km1});
        // Mass outboard times radius, for the foreshortening of everything inboard; piecewise quadratic mass moment by hand.
        const auto moment = [&](BeamReal from, BeamReal to, BeamReal m0, BeamReal slope) {  // int (m0 + slope r) r dr
          return m0 * (to * to - from * from) / 2 + slope * (to * to * to - from * from * from) / 3;
        };
        const BeamReal slope_in = -2 / BeamReal(0.7), m_in = 4 - slope_in * BeamReal(0.3);
        slice.tension = p.tip_mass * BeamReal(2) + (slice.x < 1 ? moment(slice.x, 1, m_in, slope_in) + moment(1, 2, 3, -1)
                                                                : moment(slice.x, 2, 3, -1));
        all.push_back(slice);
      }
  Slice tip;
  tip.x = 2;
  tip.dx = tip.tension = 0;
  tip.twist = 0;
  tip.rows = blade.shapeRows(2.0);
  tip.particles = {{p.tip_mass, 0, 0}};
  all.push_back(tip);
  return all;
}

struct Place {
  BeamReal y, z, y_section, z_section;
};

Place place(const Slice& slice, const Particle& particle, const Field& f, BeamReal e0, BeamReal pitch) {
  const BeamReal c = std::cos(slice.twist + f.twist), s = std::sin(slice.twist + f.twist);
  const BeamReal y_section = particle.eta * c - particle.zeta * s, z_section = particle.eta * s + particle.zeta * c;
  return {e0 * std::cos(pitch) + f.v + y_section, -e0 * std::sin(pitch) + f.w + z_section, y_section, z_section};
}

/// -1/2 sum dm |omega x r|^2 for unit speed about the shaft (no precone), and about x.
BeamReal shaftPotential(const std::vector<Slice>& all, const BeamVector& q, BeamReal e0, BeamReal pitch) {
  BeamReal sum = 0;
  for (const Slice& slice : all) {
    const Field f = slice.at(q);
    sum += slice.dx * slice.tension * (f.slope_v * f.slope_v + f.slope_w * f.slope_w) / 2;
    for (const Particle& particle : slice.particles) {
      const Place r = place(slice, particle, f, e0, pitch);
      const BeamReal dX = -r.y_section * f.slope_v - r.z_section * f.slope_w;
      const BeamReal Y = r.y * std::cos(pitch) - r.z * std::sin(pitch);
      sum -= particle.dm * (2 * slice.x * dX + Y * Y) / 2;
    }
  }
  return sum;
}

BeamReal axialPotential(const std::vector<Slice>& all, const BeamVector& q, BeamReal e0, BeamReal pitch) {
  BeamReal sum = 0;
  for (const Slice& slice : all)
    for (const Particle& particle : slice.particles) {
      const Place r = place(slice, particle, slice.at(q), e0, pitch);
      sum -= particle.dm * (r.y * r.y + r.z * r.z) / 2;
    }
  return sum;
}

/// First and second derivative along q at 0, differences of fourth order.
struct Derivatives {
  double first, second;
};

Derivatives differentiate(const std::function<BeamReal(const BeamVector&)>& U, const BeamVector& q) {
  const BeamReal h = 1e-3L;
  const BeamReal u0 = U(0 * q), p1 = U(h * q), m1 = U(-h * q), p2 = U(2 * h * q), m2 = U(-2 * h * q);
  return {static_cast<double>((8 * (p1 - m1) - (p2 - m2)) / (12 * h)),
          static_cast<double>((16 * (p1 + m1) - (p2 + m2) - 30 * u0) / (12 * h * h))};
}

class SectionParticles : public ::testing::Test {
 protected:
  SectionParticles() : p(skewBlade()), blade(assembleBlade(p)), all(slices(p, blade)) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 6; ++i) {
      BeamVector q(blade.size());
      for (BeamReal& value : q) value = uniform(random);
      directions.push_back(q);
    }
  }

  BladeProperties p;
  BladeMatrices blade;
  std::vector<Slice> all;
  std::vector<BeamVector> directions;
};

// Fourth-order differences with h = 1e-3: h^4 times sixth derivatives, about 1e-12; entries are of order 1.
constexpr double kTolerance = 1e-9;

TEST_F(SectionParticles, stiffnessAndLoadOfTheRotationFollowFromThePotential) {
  for (double pitch : {0.0, 0.3, -0.8})
    for (const BeamVector& q : directions) {
      const Derivatives d = differentiate([&](const BeamVector& x) { return shaftPotential(all, x, p.root_lead, pitch); }, q);
      const BeamMatrix K1 = blade.stiffness(1, pitch) - blade.K0;
      EXPECT_NEAR(static_cast<double>(q.dot(K1 * q)), d.second, kTolerance) << "pitch " << pitch;
      EXPECT_NEAR(static_cast<double>(-blade.steadyLoad(1, pitch).dot(q)), d.first, kTolerance) << "pitch " << pitch;
    }
}

TEST_F(SectionParticles, rotationAboutTheBladeAxisToo) {
  // Precone 90 deg turns the rotor speed into the blade's axis.
  for (double pitch : {0.0, 0.3})
    for (const BeamVector& q : directions) {
      const Derivatives d = differentiate([&](const BeamVector& x) { return axialPotential(all, x, p.root_lead, pitch); }, q);
      const BeamMatrix K1 = blade.stiffness(1, pitch, M_PI / 2) - blade.K0;
      EXPECT_NEAR(static_cast<double>(q.dot(K1 * q)), d.second, kTolerance) << "pitch " << pitch;
      EXPECT_NEAR(static_cast<double>(-blade.steadyLoad(1, pitch, M_PI / 2).dot(q)), d.first, kTolerance) << "pitch " << pitch;
    }
}

TEST_F(SectionParticles, massCoriolisAndInertiaLoadsFollowFromVelocities) {
  const BeamVector& a = directions[0];
  for (const BeamVector& b : directions) {
    // Velocity of a particle per unit rate of a field: (v - z f, w + y f) with the particle's undeformed y, z.
    BeamReal mass = 0, coriolis = 0, along_v = 0, along_w = 0, along_rv = 0, along_rw = 0, about_x = 0;
    for (const Slice& slice : all) {
      const Field fa = slice.at(a), fb = slice.at(b);
      for (const Particle& particle : slice.particles) {
        const Place r = place(slice, particle, Field{}, 0, 0);
        const BeamReal ya = fa.v - r.z * fa.twist, za = fa.w + r.y * fa.twist;
        const BeamReal yb = fb.v - r.z * fb.twist, zb = fb.w + r.y * fb.twist;
        mass += particle.dm * (ya * yb + za * zb);
        coriolis += particle.dm * (za * yb - ya * zb);  // x-axis turning: force -2 dm (omega_x, 0, 0) x velocity, negated
        along_v += particle.dm * yb;
        along_w += particle.dm * zb;
        along_rv += particle.dm * slice.x * yb;
        along_rw += particle.dm * slice.x * zb;
        about_x += particle.dm * (r.y * zb - r.z * yb);
      }
    }
    EXPECT_NEAR(static_cast<double>(a.dot(blade.M * b) - mass), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(a.dot(blade.G * b) - coriolis), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(blade.inertia_v.dot(b) - along_v), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(blade.inertia_w.dot(b) - along_w), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(blade.inertia_rv.dot(b) - along_rv), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(blade.inertia_rw.dot(b) - along_rw), 0, 1e-13);
    EXPECT_NEAR(static_cast<double>(blade.inertia_twist.dot(b) - about_x), 0, 1e-13);
  }
}

TEST(ConingLoad, pressesARigidHingedBladeTowardTheDisc) {
  // Flap angle w = r: generalised load -Omega^2 sin p cos p I; at 90 deg of pitch the disc lies toward -y.
  BladeProperties p = uniformBlade(3);
  p.root.flap_hinge = p.root.lag_hinge = true;
  const BladeMatrices blade = assembleBlade(p);
  BeamVector flap = BeamVector::Zero(blade.size()), lag = flap;
  for (std::size_t node = 0; node < p.nodes.size(); ++node) {
    const int base = kNodeDofs * static_cast<int>(node);
    if (node > 0) flap[blade.free_dof[base + kDofW]] = lag[blade.free_dof[base + kDofV]] = p.nodes[node];
    flap[blade.free_dof[base + kDofSlopeW]] = lag[blade.free_dof[base + kDofSlopeV]] = 1;
  }
  const double precone = 0.1, expected = -9 * std::sin(precone) * std::cos(precone) / 3;
  EXPECT_NEAR(static_cast<double>(blade.steadyLoad(3, 0, precone).dot(flap)), expected, 1e-14);
  EXPECT_NEAR(static_cast<double>(blade.steadyLoad(3, 0, precone).dot(lag)), 0, 1e-14);
  EXPECT_NEAR(static_cast<double>(blade.steadyLoad(3, M_PI / 2, precone).dot(lag)), expected, 1e-14);
}

}  // namespace
}  // namespace heerk_rotor
