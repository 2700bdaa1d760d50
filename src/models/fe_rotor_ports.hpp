#pragma once
#include <string>
#include <vector>

#include "heerk_rotor/core/subsystem_model.hpp"
#include "heerk_rotor/models/fe_rotor_parameters.hpp"

namespace heerk_rotor {

/// Ports of `fe_rotor` by number, in the order of the lists below.
enum FeRotorInput { kHubMotion, kMountVelocity, kPitch, kPitchRate, kLoads, kHubAcceleration, kMountAcceleration, kPitchAcceleration, kHubGravity, kFeRotorInputs };
enum FeRotorOutput {
  kSectionPosition, kSectionVelocity, kSectionAxes, kSectionPitch, kSectionPitchRate, kSectionAcceleration, kRotorForce, kTiltingMoment, kBladeReaction, kRootLoad,
  kLag, kLagRate, kFlap, kFlapRate, kFlapAcceleration, kTipTwist, kMomentum, kAngularMomentum, kEnergy, kDissipation
};

/// names: of the modal coordinates, [mode][blade]; from_drive: which of them count from the drive. Coordinates, then their rates.
std::vector<State> feRotorStates(const std::vector<std::string>& names, const std::vector<bool>& from_drive);
std::vector<InputPort> feRotorInputs(const RotorSections& sections);
std::vector<OutputPort> feRotorOutputs(const FeRotorParameters& parameters);

}  // namespace heerk_rotor
