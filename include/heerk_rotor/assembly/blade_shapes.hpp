#pragma once
#include <array>
#include <vector>

#include "heerk_rotor/core/coupled_system.hpp"
#include "heerk_rotor/integrate/simulation.hpp"

namespace heerk_rotor {

/// How elastic blades stand and what air loads them, for drawing: single precision, and no more sections than a picture needs.
/// Axes of each blade: x outboard along its azimuth, y toward the leading edge, z up along the shaft. Fixed size, so that it
/// can be handed over without a lock.
struct BladeShapes {
  static constexpr int kMaxBlades = 8;
  static constexpr int kMaxSections = 14;
  struct Section {
    float position[3];   // of the elastic axis [m]
    float chordwise[3];  // unit vector from the elastic axis to the leading edge [-]
    float load;          // air load upwards (along z), of the whole segment [N]
  };
  int blades = 0, sections = 0;  // entries in use; none for rotors whose blades are rigid
  std::array<std::array<Section, kMaxSections>, kMaxBlades> section{};  // [blade][section], inboard first
};

bool isFinite(const BladeShapes& shapes) noexcept;

/// Finds elastic blades in any coupled system, by the output ports section_position, section_axes, section_pitch and (if there
/// is one) section_loads, laid out as models/rotor_sections.hpp says.
class BladeShapeView {
 public:
  /// Throws std::invalid_argument when two subsystems offer the same port or the sizes do not fit `blades`.
  BladeShapeView(const CoupledSystem& system, int blades);

  bool present() const { return !chosen_.empty(); }
  /// The section of the model, which has `total`, that number i of the picture is: all when they fit, else as many as do, evenly
  /// chosen, innermost and outermost among them.
  static Index chosenSection(Index i, Index total);

  /// Allocation free.
  void read(const Sample& sample, BladeShapes& shapes) const noexcept;

 private:
  Index blades_ = 0;
  Index position_ = -1, axes_ = -1, pitch_ = -1, loads_ = -1;  // first entries of y
  std::vector<Index> chosen_;
};

}  // namespace heerk_rotor
