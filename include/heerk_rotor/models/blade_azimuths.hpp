#pragma once
#include <array>

namespace heerk_rotor {

/// Cosines and sines of the azimuths psi_k = psi + 2 pi (k-1) / N of all blades from those of blade 1, by constant rotations: one sine and one
/// cosine per call whatever N. The constants are exact where the exact value is 0, 1/2 or 1 and symmetric otherwise, so that blades a quarter
/// or a half turn apart have exactly swapped or opposite values.
class BladeAzimuths {
 public:
  static constexpr int kMaxBlades = 8;
  explicit BladeAzimuths(int blades);

  int blades() const { return blades_; }
  /// cosine, sine: (blades)
  void evaluate(double psi, double* cosine, double* sine) const noexcept;

 private:
  int blades_;
  std::array<double, kMaxBlades> cosine_{}, sine_{};  // of 2 pi (k-1) / N
};

}  // namespace heerk_rotor
