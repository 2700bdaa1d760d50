#include "heerk_rotor/lcm/lcm_log_packer.hpp"

namespace heerk_rotor {
namespace {

template <class Message>
void encode(const Message& message, LcmPackedEvent& event) {
  event.stamp = message.stamp;
  event.data.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(event.data.data(), 0, static_cast<int>(event.data.size()));
}

/// A field of a batch and the field of a reading it is filled from.
struct Column {
  std::vector<double> shaft_batch_t::*values;
  double ShaftReading::*value;
};
constexpr Column kColumns[] = {{&shaft_batch_t::sim_time, &ShaftReading::sim_time},
                               {&shaft_batch_t::azimuth, &ShaftReading::azimuth},
                               {&shaft_batch_t::rotor_speed, &ShaftReading::rotor_speed},
                               {&shaft_batch_t::journal_x, &ShaftReading::journal_x},
                               {&shaft_batch_t::journal_y, &ShaftReading::journal_y},
                               {&shaft_batch_t::eccentricity_ratio, &ShaftReading::eccentricity_ratio},
                               {&shaft_batch_t::bearing_force_x, &ShaftReading::bearing_force_x},
                               {&shaft_batch_t::bearing_force_y, &ShaftReading::bearing_force_y},
                               {&shaft_batch_t::film_force_x, &ShaftReading::film_force_x},
                               {&shaft_batch_t::film_force_y, &ShaftReading::film_force_y}};

}  // namespace

bool LcmLogPacker<RotorInstant>::add(const RotorInstant& instant, const LcmNote& note, const LcmEventWriter& write) {
  toLcmState(instant, note, message_);
  encode(message_, event_);
  return write(event_);
}

bool LcmLogPacker<ShaftInstant>::add(const ShaftInstant& instant, const LcmNote& note, const LcmEventWriter& write) {
  bool written = true;
  if (!continues(instant.reading)) written = flush(write);
  if (batch_.steps == 0) begin(instant.reading, note);
  append(instant.reading, note);
  return batch_.steps < kMostSteps ? written : flush(write) && written;
}

bool LcmLogPacker<ShaftInstant>::flush(const LcmEventWriter& write) {
  if (batch_.steps == 0) return true;
  encode(batch_, event_);
  batch_.steps = 0;
  return write(event_);
}

bool LcmLogPacker<ShaftInstant>::continues(const ShaftReading& reading) const {
  const std::int64_t next = batch_.step + static_cast<std::int64_t>(batch_.steps) * batch_.stride;
  return static_cast<std::int64_t>(reading.step) == next && static_cast<std::int32_t>(reading.epoch) == batch_.epoch && reading.discs == batch_.discs;
}

void LcmLogPacker<ShaftInstant>::begin(const ShaftReading& reading, const LcmNote& note) {
  batch_.stamp = note.stamp;
  batch_.step = static_cast<std::int64_t>(reading.step);
  batch_.epoch = static_cast<std::int32_t>(reading.epoch);
  batch_.discs = reading.discs;
  for (const Column& column : kColumns) (batch_.*column.values).clear();
  batch_.newton_iterations.clear();
  batch_.residual_evaluations.clear();
  for (auto* per_disc : {&batch_.disc_x, &batch_.disc_y}) {
    per_disc->resize(static_cast<std::size_t>(reading.discs));
    for (std::vector<double>& values : *per_disc) values.clear();
  }
}

void LcmLogPacker<ShaftInstant>::append(const ShaftReading& reading, const LcmNote& note) {
  ++batch_.steps;
  for (const Column& column : kColumns) (batch_.*column.values).push_back(reading.*column.value);
  for (std::size_t disc = 0; disc < batch_.disc_x.size(); ++disc) {
    batch_.disc_x[disc].push_back(reading.disc_x[disc]);
    batch_.disc_y[disc].push_back(reading.disc_y[disc]);
  }
  batch_.newton_iterations.push_back(static_cast<std::int32_t>(reading.newton_iterations));
  batch_.residual_evaluations.push_back(static_cast<std::int32_t>(reading.residual_evaluations));
  batch_.overruns = static_cast<std::int64_t>(note.overruns);
  batch_.dropped = static_cast<std::int64_t>(note.dropped);
}

}  // namespace heerk_rotor
