#include "heerk_rotor/analysis/coupling_picture.hpp"

#include <algorithm>
#include <map>
#include <locale>
#include <set>
#include <sstream>

namespace heerk_rotor {
namespace {

constexpr double kCharacter = 6.7, kLine = 15.0, kPad = 10.0, kGap = 16.0, kMatrix = 230.0, kTitle = 40.0;  // [px]
const char* const kInk = "#222222";
const char* const kFaint = "#9aa5b1";
const char* const kLoop = "#b3261e";

struct Cell {
  std::vector<std::pair<std::string, bool>> lines;  // port, in a loop
};

/// The N-squared chart: column widths and row heights follow from the texts, so that nothing overlaps.
class Chart {
 public:
  Chart(const CoupledSystem& system, const Coupling& coupling) : system_(system), n_(system.subsystems().size()) {
    std::set<Index> in_loop;
    for (const LoopInfo& loop : coupling.pruned) in_loop.insert(loop.outputs.begin(), loop.outputs.end());
    for (const CoupledSystem::Input& input : system.inputs())
      for (const Index source : input.sources) {
        const CoupledSystem::Output& output = system.outputs()[static_cast<std::size_t>(source)];
        const std::string port = output.name.substr(output.name.find('.') + 1) + " (" + std::to_string(output.size) + ")";
        auto& lines = cells_[{static_cast<std::size_t>(output.subsystem), static_cast<std::size_t>(input.subsystem)}].lines;
        const std::pair<std::string, bool> line(port, in_loop.count(source) != 0 && coupledBack(system, in_loop, input));
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
      }
    layOut();
  }
  double width() const { return x_.back(); }
  double height() const { return y_.back(); }

  void draw(std::ostringstream& svg) const {
    for (const auto& [place, cell] : cells_) drawEdge(svg, place.first, place.second, anyLoop(cell));
    for (const auto& [place, cell] : cells_) drawCell(svg, place.first, place.second, cell);
    for (std::size_t k = 0; k < n_; ++k) drawSubsystem(svg, k);
  }

 private:
  /// An input lies on a loop when an output of its owner that is in a loop feeds it through.
  static bool coupledBack(const CoupledSystem& system, const std::set<Index>& in_loop, const CoupledSystem::Input& input) {
    const Index number = &input - system.inputs().data();
    for (const Index output : in_loop) {
      const std::vector<Index>& feedthrough = system.outputs()[static_cast<std::size_t>(output)].feedthrough;
      if (std::find(feedthrough.begin(), feedthrough.end(), number) != feedthrough.end()) return true;
    }
    return false;
  }
  static bool anyLoop(const Cell& cell) { return std::any_of(cell.lines.begin(), cell.lines.end(), [](const auto& line) { return line.second; }); }
  static double textWidth(const std::string& text) { return kCharacter * static_cast<double>(text.size()); }
  std::string sizes(std::size_t k) const {
    const CoupledSystem::Subsystem& s = system_.subsystems()[k];
    return "x " + std::to_string(s.x_size) + "  u " + std::to_string(s.u_size) + "  y " + std::to_string(s.y_size);
  }

  void layOut() {
    std::vector<double> widths(n_), heights(n_, 2.0 * kLine + kPad);
    for (std::size_t k = 0; k < n_; ++k) widths[k] = std::max(textWidth(system_.subsystems()[k].name) * 1.15, textWidth(sizes(k))) + 2.0 * kPad;
    for (const auto& [place, cell] : cells_) {
      for (const auto& line : cell.lines) widths[place.second] = std::max(widths[place.second], textWidth(line.first) + 2.0 * kPad);
      heights[place.first] = std::max(heights[place.first], kLine * static_cast<double>(cell.lines.size()) + kPad);
    }
    x_.push_back(0.0);
    y_.push_back(0.0);
    for (std::size_t k = 0; k < n_; ++k) {
      x_.push_back(x_.back() + widths[k] + kGap);
      y_.push_back(y_.back() + heights[k] + kGap);
    }
  }
  double left(std::size_t k) const { return x_[k]; }
  double right(std::size_t k) const { return x_[k + 1] - kGap; }
  double top(std::size_t k) const { return y_[k]; }
  double bottom(std::size_t k) const { return y_[k + 1] - kGap; }
  double centreX(std::size_t k) const { return 0.5 * (left(k) + right(k)); }
  double centreY(std::size_t k) const { return 0.5 * (top(k) + bottom(k)); }

  void drawEdge(std::ostringstream& svg, std::size_t from, std::size_t to, bool loop) const {
    if (from == to) return;
    const char* colour = loop ? kLoop : kFaint;
    const bool forward = to > from;
    const double tip = forward ? top(to) - 1.0 : bottom(to) + 1.0, wing = forward ? -7.0 : 7.0;
    svg << "<path d=\"M" << (forward ? right(from) : left(from)) << ' ' << centreY(from) << " H" << centreX(to) << " V" << tip << "\" fill=\"none\" stroke=\"" << colour << "\"/>\n"
        << "<path d=\"M" << centreX(to) << ' ' << tip << " l-4 " << wing << " h8 z\" fill=\"" << colour << "\"/>\n";
  }
  void drawCell(std::ostringstream& svg, std::size_t from, std::size_t to, const Cell& cell) const {
    double width = 0.0;
    for (const auto& line : cell.lines) width = std::max(width, textWidth(line.first) + kPad);
    const double height = kLine * static_cast<double>(cell.lines.size()) + 4.0, y = centreY(from) - 0.5 * height;
    svg << "<rect x=\"" << centreX(to) - 0.5 * width << "\" y=\"" << y << "\" width=\"" << width << "\" height=\"" << height << "\" rx=\"3\" fill=\"white\" stroke=\"" << (anyLoop(cell) ? kLoop : kFaint) << "\"/>\n";
    for (std::size_t i = 0; i < cell.lines.size(); ++i)
      svg << "<text x=\"" << centreX(to) << "\" y=\"" << y + kLine * (static_cast<double>(i) + 0.85) << "\" text-anchor=\"middle\" fill=\"" << (cell.lines[i].second ? kLoop : kInk) << "\">" << cell.lines[i].first << "</text>\n";
  }
  void drawSubsystem(std::ostringstream& svg, std::size_t k) const {
    svg << "<rect x=\"" << left(k) << "\" y=\"" << top(k) << "\" width=\"" << right(k) - left(k) << "\" height=\"" << bottom(k) - top(k) << "\" rx=\"4\" fill=\"#dce8f5\" stroke=\"" << kInk << "\"/>\n"
        << "<text x=\"" << centreX(k) << "\" y=\"" << centreY(k) - 3.0 << "\" text-anchor=\"middle\" font-weight=\"bold\">" << system_.subsystems()[k].name << "</text>\n"
        << "<text x=\"" << centreX(k) << "\" y=\"" << centreY(k) + 12.0 << "\" text-anchor=\"middle\">" << sizes(k) << "</text>\n";
  }

  const CoupledSystem& system_;
  std::size_t n_;
  std::map<std::pair<std::size_t, std::size_t>, Cell> cells_;  // (from, to)
  std::vector<double> x_, y_;
};

/// Side of a pattern [px]: entries of small ones are not blown up.
double side(const SparsityPattern& pattern) { return std::min(kMatrix, 24.0 * static_cast<double>(std::max<Index>(pattern.size, 1))); }

void drawPattern(std::ostringstream& svg, double x, double y, const std::string& title, const SparsityPattern& pattern) {
  const double extent = side(pattern);
  svg << "<text x=\"" << x << "\" y=\"" << y - 8.0 << "\">" << title << ": " << pattern.size << " x " << pattern.size << ", " << pattern.nonzeros() << " nonzeros</text>\n<rect x=\"" << x << "\" y=\"" << y
      << "\" width=\"" << extent << "\" height=\"" << extent << "\" fill=\"white\" stroke=\"" << kInk << "\"/>\n";
  if (pattern.size == 0) return;
  const double pitch = extent / static_cast<double>(pattern.size), dot = std::max(pitch * 0.9, 1.2);
  svg << "<path fill=\"" << kInk << "\" d=\"";
  for (Index j = 0; j < pattern.size; ++j)
    for (Index p = pattern.start[static_cast<std::size_t>(j)]; p < pattern.start[static_cast<std::size_t>(j) + 1]; ++p)
      svg << 'M' << x + pitch * (static_cast<double>(j) + 0.5) - 0.5 * dot << ' ' << y + pitch * (static_cast<double>(pattern.rows[static_cast<std::size_t>(p)]) + 0.5) - 0.5 * dot << 'h' << dot << 'v' << dot << 'h' << -dot << 'z';
  svg << "\"/>\n";
}

}  // namespace

std::string couplingPicture(const CoupledSystem& system, const Coupling& coupling) {
  const Chart chart(system, coupling);
  const double loops = static_cast<double>(coupling.pruned.size());
  double patterns = 0.0;  // height of the tallest column of patterns
  for (std::size_t l = 0; l < coupling.pruned.size(); ++l)
    patterns = std::max(patterns, side(coupling.full[l].gradient) + side(coupling.pruned[l].gradient) + side(coupling.pruned[l].factors) + 3.0 * kTitle);
  const double width = chart.width() + (loops > 0.0 ? 40.0 + loops * (kMatrix + 60.0) : 0.0) + 40.0;
  const double height = std::max(chart.height(), patterns) + 70.0;
  std::ostringstream svg;
  svg.imbue(std::locale::classic());
  svg.precision(6);
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height << "\" viewBox=\"-20 -50 " << width << ' ' << height
      << "\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"11\" fill=\"" << kInk << "\">\n<rect x=\"-20\" y=\"-50\" width=\"" << width << "\" height=\"" << height << "\" fill=\"white\"/>\n"
      << "<text x=\"0\" y=\"-26\" font-size=\"13\" font-weight=\"bold\">Subsystems and connections</text>\n<text x=\"0\" y=\"-10\">outputs leave along the row, inputs enter along the column; <tspan fill=\"" << kLoop
      << "\">red: algebraic loop</tspan></text>\n";
  chart.draw(svg);
  for (std::size_t l = 0; l < coupling.pruned.size(); ++l) {
    const double x = chart.width() + 40.0 + static_cast<double>(l) * (kMatrix + 60.0);
    svg << "<text x=\"" << x << "\" y=\"-26\" font-size=\"13\" font-weight=\"bold\">Loop " << l + 1 << "</text>\n";
    const LoopInfo &full = coupling.full[l], &pruned = coupling.pruned[l];
    double y = 12.0;
    drawPattern(svg, x, y, "all entries", full.gradient);
    drawPattern(svg, x, y += side(full.gradient) + kTitle, "pruned", pruned.gradient);
    drawPattern(svg, x, y += side(pruned.gradient) + kTitle, "L + U, pruned", pruned.factors);
  }
  svg << "</svg>\n";
  return svg.str();
}

}  // namespace heerk_rotor
