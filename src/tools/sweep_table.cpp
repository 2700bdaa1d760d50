#include "heerk_rotor/tools/sweep_table.hpp"

#include <limits>

#include "heerk_rotor/core/hash_text.hpp"
#include "heerk_rotor/tools/csv_cell.hpp"
#include "heerk_rotor/tools/number_text.hpp"

namespace heerk_rotor {
namespace {

/// Several lines as one: a row of the table is one line for every reader.
std::string oneLine(const std::string& lines) {
  std::string result;
  for (const char c : lines) result += c == '\n' ? std::string("; ") : std::string(1, c);
  return result;
}

}  // namespace

SweepTable::SweepTable(const Sweep& sweep, const std::vector<std::string>& units, const std::vector<Signal>& signals) : sweep_(sweep), signals_(signals.size()) {
  header_ = csvHeaderCell("run", "");
  const std::vector<std::string> keys = sweep.keys();
  for (std::size_t i = 0; i < keys.size(); ++i) header_ += "," + csvHeaderCell(keys[i], units[i]);
  header_ += ",status [-],steps [-],time [s],state_hash [-]";
  for (const Signal& signal : signals)
    for (const char* value : {".final", ".mean", ".half_peak_to_peak", ".min", ".max"}) header_ += "," + csvHeaderCell(signal.name + value, signal.unit);
  header_ += ",message [-]\n";
}

std::string SweepTable::row(std::uint64_t run, const SweepOutcome& outcome) const {
  std::string line = numberText(run);
  for (const std::string& value : sweep_.values(run)) line += "," + csvCell(value);
  line += "," + outcome.status + "," + numberText(outcome.steps) + "," + numberText(outcome.simulated_time) + "," + hashText(outcome.state_hash);
  for (std::size_t i = 0; i < signals_; ++i) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool known = outcome.status == "done" && i < outcome.present.size() && outcome.present[i];
    const SignalSummary s = known ? outcome.summaries[i] : SignalSummary{nan, nan, nan, nan, nan};
    for (const double value : {s.final, s.mean, s.half_peak_to_peak, s.min, s.max}) line += "," + (known ? numberText(value) : std::string("nan"));
  }
  return line + "," + csvCell(oneLine(outcome.message)) + "\n";
}

}  // namespace heerk_rotor
