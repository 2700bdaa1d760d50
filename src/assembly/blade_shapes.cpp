#include "heerk_rotor/assembly/blade_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "heerk_rotor/assembly/non_finite.hpp"
#include "heerk_rotor/models/rotor_sections.hpp"

namespace heerk_rotor {
namespace {

const CoupledSystem::Output* findOutput(const CoupledSystem& system, const std::string& port) {
  const CoupledSystem::Output* found = nullptr;
  for (const CoupledSystem::Output& output : system.outputs()) {
    if (output.name.substr(output.name.rfind('.') + 1) != port) continue;
    if (found != nullptr) throw std::invalid_argument("blade shapes: both " + found->name + " and " + output.name + " offer " + port + "; one subsystem must");
    found = &output;
  }
  return found;
}

}  // namespace

bool isFinite(const BladeShapes& shapes) noexcept {
  double sum = 0.0;
  for (int k = 0; k < shapes.blades; ++k)
    for (int i = 0; i < shapes.sections; ++i) {
      const BladeShapes::Section& s = shapes.section[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      sum += nonFinite(s.position) + nonFinite(s.chordwise) + 0.0 * s.load;
    }
  return sum == 0.0;
}

BladeShapeView::BladeShapeView(const CoupledSystem& system, int blades) : blades_(blades) {
  const CoupledSystem::Output* pitch = findOutput(system, "section_pitch");
  if (pitch == nullptr || blades < 1) return;
  const Index sections = pitch->size / blades_;
  const auto begin = [&](const std::string& port, Index components) -> Index {
    const CoupledSystem::Output* output = findOutput(system, port);
    if (output == nullptr) return -1;
    const Index expected = sections * components * blades_;
    if (output->size != expected)
      throw std::invalid_argument("blade shapes: " + output->name + " has " + std::to_string(output->size) + " entries, expected " + std::to_string(expected) + " (" +
                                  std::to_string(sections) + " sections, " + std::to_string(components) + " components, " + std::to_string(blades_) + " blades)");
    return output->begin;
  };
  pitch_ = begin("section_pitch", 1);
  position_ = begin("section_position", 3);
  axes_ = begin("section_axes", 6);
  loads_ = begin("section_loads", 4);
  if (sections < 1 || position_ < 0 || axes_ < 0) return;
  const Index count = std::min<Index>(sections, BladeShapes::kMaxSections);
  for (Index i = 0; i < count; ++i) chosen_.push_back(chosenSection(i, sections));
}

Index BladeShapeView::chosenSection(Index i, Index total) {
  const Index count = std::min<Index>(total, BladeShapes::kMaxSections);
  return count > 1 ? (i * (total - 1) + (count - 1) / 2) / (count - 1) : 0;  // rounded to the nearest
}

void BladeShapeView::read(const Sample& sample, BladeShapes& shapes) const noexcept {
  shapes.blades = present() ? static_cast<int>(blades_) : 0;
  shapes.sections = static_cast<int>(chosen_.size());
  const double* y = sample.y.data();
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const Index section = chosen_[i];
    for (Index k = 0; k < blades_; ++k) {
      const auto at = [&](Index port, Index component, Index components) { return y[port + sectionEntry(section, component, components, k, blades_)]; };
      BladeShapes::Section& target = shapes.section[static_cast<std::size_t>(k)][i];
      // Pitched nose up, the unpitched axes t (toward the leading edge) and n (up) give t cos(pitch) + n sin(pitch).
      const double pitch = at(pitch_, 0, 1), cosine = std::cos(pitch), sine = std::sin(pitch);
      for (Index c = 0; c < 3; ++c) {
        target.position[c] = static_cast<float>(at(position_, c, 3));
        target.chordwise[c] = static_cast<float>(cosine * at(axes_, c, 6) + sine * at(axes_, c + 3, 6));
      }
      target.load = loads_ >= 0 ? static_cast<float>(at(loads_, 2, 4)) : 0.0f;
    }
  }
}

}  // namespace heerk_rotor
