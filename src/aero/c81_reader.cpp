#include "heerk_rotor/aero/c81_reader.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace heerk_rotor {
namespace {

constexpr std::size_t kWidth = 7;       // of a number
constexpr std::size_t kPerLine = 9;     // numbers on a line, behind the first seven columns
constexpr std::size_t kNameWidth = 30;  // of the header
constexpr std::size_t kMostProblems = 20;
const char* const kBlockName[3] = {"lift", "drag", "moment"};

struct Stop {};  // the rest of the file cannot be understood

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Columns [begin, begin + width), blank where the line is shorter.
std::string columns(const std::string& line, std::size_t begin, std::size_t width) {
  std::string text = begin < line.size() ? line.substr(begin, width) : "";
  text.resize(width, ' ');
  return text;
}

/// A Fortran F7.0 field: [sign] digits [. digits] [exponent: e, d, or only a sign, as in 1.5-3].
bool parseNumber(const std::string& text, double& value) {
  std::string c_text;
  std::size_t i = 0, digits = 0;
  const auto takeDigits = [&] {
    std::size_t n = 0;
    for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i, ++n) c_text += text[i];
    return n;
  };
  const auto takeSign = [&] {
    if (i >= text.size() || (text[i] != '+' && text[i] != '-')) return false;
    c_text += text[i++];
    return true;
  };
  takeSign();
  digits += takeDigits();
  if (i < text.size() && text[i] == '.') {
    c_text += text[i++];
    digits += takeDigits();
  }
  if (digits == 0) return false;
  if (i < text.size()) {
    const bool letter = std::string("eEdD").find(text[i]) != std::string::npos;
    if (letter) ++i;
    c_text += 'e';
    if (!takeSign() && !letter) return false;
    if (takeDigits() == 0) return false;
  }
  value = std::strtod(c_text.c_str(), nullptr);
  return i == text.size() && std::isfinite(value);
}

std::string show(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

class Reader {
 public:
  Reader(std::istream& in, const std::string& name) : name_(name) {
    for (std::string line; std::getline(in, line);) {
      while (!line.empty() && (line.back() == '\r' || line.back() == '\x1a')) line.pop_back();  // DOS line and file ends
      lines_.push_back(line);
    }
  }

  C81Reading read() {
    try {
      std::size_t counts[6];
      readHeader(counts);
      C81Block* blocks[3] = {&result_.deck.lift, &result_.deck.drag, &result_.deck.moment};
      for (int b = 0; b < 3; ++b) readBlock(kBlockName[b], counts[2 * b], counts[2 * b + 1], *blocks[b]);
      if (result_.ok()) warn();
    } catch (const Stop&) {
    }
    return std::move(result_);
  }

 private:
  std::string at(std::size_t line) const { return name_ + ":" + std::to_string(line) + ": "; }

  void problem(std::size_t line, const std::string& text) {
    result_.problems.push_back(at(line) + text);
    if (result_.problems.size() >= kMostProblems) {
      result_.problems.push_back(at(line) + "further problems are not listed");
      throw Stop();
    }
  }

  /// Six I2 counts behind the name; blanks within a count are ignored as in Fortran, so "9 " is 9.
  static bool parseCounts(const std::string& line, std::size_t (&counts)[6]) {
    if (line.size() <= kNameWidth) return false;
    for (int k = 0; k < 6; ++k) {
      const std::string text = trimmed(columns(line, kNameWidth + 2 * k, 2));
      if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return false;
      counts[k] = std::strtoul(text.c_str(), nullptr, 10);
    }
    return true;
  }

  void readHeader(std::size_t (&counts)[6]) {
    for (next_ = 0; next_ < lines_.size(); ++next_) {
      if (!parseCounts(lines_[next_], counts)) continue;
      result_.deck.name = trimmed(lines_[next_].substr(0, kNameWidth));
      header_ = ++next_;
      bool usable = true;
      for (int k = 0; k < 6; ++k) {
        const std::size_t least = k % 2 == 0 ? 1 : 2;
        if (counts[k] >= least) continue;
        problem(header_, std::string("the count of ") + (k % 2 == 0 ? "Mach numbers" : "angles") + " of the " + kBlockName[k / 2] + " block is " +
                             std::to_string(counts[k]) + ", expected at least " + std::to_string(least));
        usable = false;
      }
      if (!usable) throw Stop();
      return;
    }
    problem(lines_.empty() ? 1 : lines_.size(), "the file ends without a header, expected a line with 30 columns of name and six counts of two columns (Mach, alpha for "
                                                "lift, drag, moment)");
    throw Stop();
  }

  const std::string& takeLine(const std::string& expected) {
    if (next_ >= lines_.size()) {
      problem(lines_.size(), "the file ends here, expected " + expected);
      throw Stop();
    }
    const std::string& line = lines_[next_++];
    if (line.find('\t') != std::string::npos) problem(next_, "found a tab, expected blanks (the format has fixed columns)");
    return line;
  }

  double number(const std::string& line, std::size_t column, const std::string& what) {
    const std::string text = trimmed(columns(line, column, kWidth));
    double value = 0.0;
    if (text.empty())
      problem(next_, "columns " + std::to_string(column + 1) + " to " + std::to_string(column + kWidth) + " are blank, expected " + what);
    else if (!parseNumber(text, value))
      problem(next_, "found '" + text + "' in columns " + std::to_string(column + 1) + " to " + std::to_string(column + kWidth) + ", expected " + what);
    return value;
  }

  /// `count` numbers in columns 8 to 70 of `line` and of continuation lines, whose first seven columns hold no number.
  void numbers(std::string line, std::size_t count, const std::string& what, std::vector<double>& values) {
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0 && i % kPerLine == 0) {
        line = takeLine(what + ", a continuation line for numbers " + std::to_string(i + 1) + " to " + std::to_string(count));
        refuseFirstNumber(line, "a continuation line (" + std::to_string(count) + " Mach numbers are announced in line " + std::to_string(header_) + ")");
      }
      values.push_back(number(line, kWidth * (1 + i % kPerLine), what + ", number " + std::to_string(i + 1) + " of " + std::to_string(count)));
    }
  }

  void refuseFirstNumber(const std::string& line, const std::string& expected) {
    const std::string text = trimmed(columns(line, 0, kWidth));
    double value;
    if (!text.empty() && parseNumber(text, value)) problem(next_, "found '" + text + "' in columns 1 to 7, expected them blank: " + expected);
  }

  void readBlock(const std::string& name, std::size_t mach_count, std::size_t alpha_count, C81Block& block) {
    const std::string of_block = " of the " + name + " block";
    const std::string mach_line = takeLine("the Mach numbers" + of_block);
    const std::size_t line_of_mach = next_;
    refuseFirstNumber(mach_line, "the Mach numbers" + of_block + " (" + std::to_string(alpha_count) + " angles are announced for each block as in line " +
                                     std::to_string(header_) + ")");
    numbers(mach_line, mach_count, "Mach numbers" + of_block, block.mach);
    const std::size_t before = result_.problems.size();
    for (std::size_t j = 0; j < mach_count; ++j) {
      if (block.mach[j] < 0.0) problem(line_of_mach, "found Mach number " + show(block.mach[j]) + of_block + ", expected >= 0");
      if (j > 0 && !(block.mach[j] > block.mach[j - 1]) && result_.problems.size() == before)
        problem(line_of_mach, "Mach number " + show(block.mach[j]) + of_block + " follows " + show(block.mach[j - 1]) + ", expected increasing values");
    }
    for (std::size_t i = 0; i < alpha_count; ++i) {
      const std::string what = "row " + std::to_string(i + 1) + " of " + std::to_string(alpha_count) + of_block;
      const std::string line = takeLine(what);
      const std::size_t line_of_row = next_, known = result_.problems.size();
      block.alpha_deg.push_back(number(line, 0, "alpha [deg], " + what));
      const double alpha = block.alpha_deg.back();
      if (result_.problems.size() == known) {
        if (std::abs(alpha) > 180.0) problem(line_of_row, "found alpha = " + show(alpha) + " deg, expected -180 to 180 (" + what + ")");
        if (i > 0 && !(alpha > block.alpha_deg[i - 1]))
          problem(line_of_row, "alpha = " + show(alpha) + " deg follows " + show(block.alpha_deg[i - 1]) + ", expected increasing values (" + what + ")");
      }
      numbers(line, mach_count, what, block.values);
    }
  }

  void warn() {
    const C81Deck& deck = result_.deck;
    const auto warning = [&](const std::string& text) { result_.warnings.push_back(at(header_) + text); };
    if (deck.lift.values == deck.drag.values && deck.lift.values == deck.moment.values)
      warning("lift, drag and moment have the same values: a placeholder deck");
    else if (deck.lift.values == deck.drag.values || deck.lift.values == deck.moment.values || (deck.drag.values == deck.moment.values))
      warning("two of the three blocks have the same values: probably a placeholder deck");
    for (double drag : deck.drag.values)
      if (drag < 0.0) {
        warning("drag is negative somewhere (" + show(drag) + ")");
        break;
      }
    const C81Block* blocks[3] = {&deck.lift, &deck.drag, &deck.moment};
    for (int b = 0; b < 3; ++b) {
      const C81Block& block = *blocks[b];
      const std::string of_block = std::string(" of the ") + kBlockName[b] + " block";
      if (block.mach.back() < 0.8) warning("Mach numbers" + of_block + " end at " + show(block.mach.back()) + " (below 0.8); higher ones use the last column");
      if (block.alpha_deg.front() > -180.0 || block.alpha_deg.back() < 180.0) {
        warning("alpha" + of_block + " spans " + show(block.alpha_deg.front()) + " to " + show(block.alpha_deg.back()) +
                " deg, not -180 to 180; values are held constant outside");
        continue;
      }
      for (std::size_t j = 0; j < block.mach.size(); ++j)
        if (block.value(0, j) != block.value(block.alpha_deg.size() - 1, j)) {
          warning("values" + of_block + " differ at -180 and 180 deg for Mach " + show(block.mach[j]) + ": the coefficient jumps there");
          break;
        }
    }
  }

  std::string name_;
  std::vector<std::string> lines_;
  std::size_t next_ = 0;    // index of the next line; at the same time the number of the one taken last
  std::size_t header_ = 0;  // line number
  C81Reading result_;
};

}  // namespace

C81Reading readC81(std::istream& in, const std::string& name) { return Reader(in, name).read(); }

C81Reading readC81File(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    C81Reading result;
    result.problems.push_back(path + ": cannot be opened, expected an airfoil deck in the C81 format");
    return result;
  }
  return readC81(file, path);
}

}  // namespace heerk_rotor
