#pragma once
#include <memory>

#include "heerk_rotor/models/registry.hpp"

namespace heerk_rotor {

/// One function per registered type: reads the section, records problems, returns the model (nullptr only with a problem). Each stands at the
/// end of its model's source file, so that parameters, their keys and their ranges are found together.
using Made = std::unique_ptr<SubsystemModel>;

Made makeFeRotor(Section& section, const BuildContext& context);
Made makeMount(Section& section, const BuildContext& context);
Made makeBladeAirloads(Section& section, const BuildContext& context);
Made makeElasticMast(Section& section, const BuildContext& context);
Made makeRigidMast(Section& section, const BuildContext& context);
Made makeDrive(Section& section, const BuildContext& context);
Made makeSwashplate(Section& section, const BuildContext& context);
Made makeUniformInflow(Section& section, const BuildContext& context);
Made makeDreesInflow(Section& section, const BuildContext& context);
Made makePrescribedInflow(Section& section, const BuildContext& context);
Made makePittPetersInflow(Section& section, const BuildContext& context);
Made makeGovernedDrive(Section& section, const BuildContext& context);
Made makeRotorCoefficients(Section& section, const BuildContext& context);
Made makeShaftRotor(Section& section, const BuildContext& context);
Made makeSqueezeFilmDamper(Section& section, const BuildContext& context);
Made makeSpeedRamp(Section& section, const BuildContext& context);

}  // namespace heerk_rotor
