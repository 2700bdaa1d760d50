#pragma once
#include "heerk_rotor/assembly/blade_shapes.hpp"
#include "heerk_rotor/assembly/rotor_view.hpp"
#include "heerk_rotor/assembly/shaft_shape.hpp"
#include "heerk_rotor/assembly/shaft_view.hpp"
#include "heerk_rotor/realtime/command_source.hpp"
#include "heerk_rotor/realtime/snapshot_ring.hpp"

namespace heerk_rotor {

/// What travels from the step thread to publishers and recorders.
template <class Reading>
struct InstantOf {
  Reading reading;
  CommandSource source = CommandSource::kNone;
};

/// What the display is told beyond that: too much for every step of a log.
template <class Reading, class Shape>
struct PictureOf {
  InstantOf<Reading> instant;
  Shape shape;
};

/// The two kinds of machine. A kind says how an instant is read and what it is made of; everything that hands instants on is a
/// template over it or over its Instant.
struct RotorKind {
  using View = RotorView;
  using Instant = InstantOf<RotorReading>;
  using Picture = PictureOf<RotorReading, BladeShapes>;
  using ShapeView = BladeShapeView;
  static ShapeView shapeView(const CoupledSystem& system, const View& view) { return ShapeView(system, view.blades()); }
};

struct ShaftKind {
  using View = ShaftView;
  using Instant = InstantOf<ShaftReading>;
  using Picture = PictureOf<ShaftReading, ShaftShape>;
  using ShapeView = ShaftShapeView;
  static ShapeView shapeView(const CoupledSystem& system, const View&) { return ShapeView(system); }
};

using RotorInstant = RotorKind::Instant;
using RotorPicture = RotorKind::Picture;
using RotorRing = SnapshotRing<RotorInstant>;
using ShaftInstant = ShaftKind::Instant;
using ShaftPicture = ShaftKind::Picture;
using ShaftRing = SnapshotRing<ShaftInstant>;
static_assert(sizeof(ShaftInstant) < 300, "ten seconds of a shaft are a million instants");

}  // namespace heerk_rotor
