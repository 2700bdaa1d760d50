#pragma once

namespace heerk_rotor {

/// Force of a squeeze film on a journal that does not turn in it: short bearing (pressure parabolic over the length), incompressible.
///
/// Reynolds' equation d/dz(h^3 dp/dz) = 12 mu dh/dt with the gap h = c (1 - rho . n) at the angle whose unit vector is n gives, integrated
/// over length and circumference, with k = mu R L^3 / c^3, v = |v| u the velocity and beta measured from u:
///   F = -k |v| (Jc u + Js u_perp),  Jc, Js = int cos(beta) (cos(beta), sin(beta)) / (1 - a cos(beta) - b sin(beta))^3 dbeta,
/// a = rho . u, b = rho . u_perp, u_perp = (-u_y, u_x); over -pi/2 .. pi/2 for the half film (no pressure below ambient, cavitated), over
/// the whole circumference for the full film. This is Liu & Zhang's eq. (15), with the angle of the velocity taken about the housing
/// centre (the printed sign feeds energy in). Here in closed form, without the usual singularity at rho = 0: with D = 1 - a^2 - b^2,
/// S = atan2(sqrt(D), -a),
///   Jc = 3 a / D^2 + S (1 - b^2 + 2 a^2) / D^(5/2),  Js = b (2 + a^2 / (1 - b^2)) / D^2 + 3 a b S / D^(5/2);
/// the full film has S = pi and none of the terms without S. F . v <= 0 always.
class SqueezeFilm {
 public:
  struct Parameters {
    double clearance = 0.0;  // radial, c [m]
    double length = 0.0;     // L [m]
    double radius = 0.0;     // R [m]
    double viscosity = 0.0;  // mu [Pa s]
    bool full = false;       // whole circumference instead of half
  };
  /// |rho| is limited to this: at 1 the journal touches and the force is infinite. At 0.999 it is 3e7 times that of the centre.
  static constexpr double kLargestEccentricity = 0.999;

  struct Force {
    double x, y;           // on the journal [N]
  };

  explicit SqueezeFilm(const Parameters& parameters);

  /// rho: journal from the housing centre [parts of the clearance]; v: its velocity [m/s].
  Force force(double rho_x, double rho_y, double v_x, double v_y) const noexcept;

  /// mu R L^3 / c^3 [N s/m]; damping of the centred half film is k pi / 2.
  double k() const { return k_; }

 private:
  double k_;
  bool full_;
};

}  // namespace heerk_rotor
