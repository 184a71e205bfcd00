// SPDX-License-Identifier: Apache-2.0
// The plot of the report: screen PSNR over bytes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tools/files/text.hpp"
#include "tools/report/report.hpp"

namespace tetrakis::tools {
namespace {

constexpr double kWidth = 640, kHeight = 300, kLeft = 56, kRight = 16, kTop = 16, kBottom = 40;

struct Dot {
  double bytes, psnr;
};

std::vector<Dot> finiteDots(const std::vector<ReportRow>& rows) {
  std::vector<Dot> dots;
  for (const ReportRow& row : rows) {
    const std::optional<double>& psnr = row.measurement.screen_psnr;
    if (psnr && std::isfinite(*psnr))
      dots.push_back({static_cast<double>(row.measurement.bytes), *psnr});
  }
  return dots;
}

/// Maps bytes (log 2) and dB (linear) to the drawing area.
class Axes {
 public:
  explicit Axes(const std::vector<Dot>& dots) {
    for (const Dot& dot : dots) {
      low_ = std::min(low_, std::floor(dot.psnr));
      high_ = std::max(high_, std::ceil(dot.psnr));
      first_ = std::min(first_, std::log2(dot.bytes));
      last_ = std::max(last_, std::log2(dot.bytes));
    }
    if (high_ == low_) ++high_;
    if (last_ == first_) ++last_;
  }
  double x(double bytes) const {
    return kLeft + (std::log2(bytes) - first_) / (last_ - first_) * (kWidth - kLeft - kRight);
  }
  double y(double psnr) const {
    return kTop + (high_ - psnr) / (high_ - low_) * (kHeight - kTop - kBottom);
  }
  double low() const { return low_; }
  double high() const { return high_; }

 private:
  double low_ = 1e9, high_ = -1e9, first_ = 1e9, last_ = -1e9;
};

std::string label(double x, double y, const std::string& anchor, const std::string& text) {
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" text-anchor=\"" + anchor +
         "\">" + text + "</text>";
}

std::string gridLines(const Axes& axes) {
  const double step = std::max(1.0, std::ceil((axes.high() - axes.low()) / 6));
  std::string svg;
  for (double psnr = axes.low(); psnr <= axes.high(); psnr += step) {
    const std::string y = fixed(axes.y(psnr), 1);
    svg += "<line class=\"grid\" x1=\"" + fixed(kLeft, 0) + "\" x2=\"" + fixed(kWidth - kRight, 0) +
           "\" y1=\"" + y + "\" y2=\"" + y + "\"/>";
    svg += label(kLeft - 8, axes.y(psnr) + 4, "end", fixed(psnr, 0) + " dB");
  }
  return svg;
}

}  // namespace

std::string plotScreenPsnr(const std::vector<ReportRow>& rows) {
  const std::vector<Dot> dots = finiteDots(rows);
  if (dots.empty()) return "<p>Every cut is exact on the screen.</p>";
  const Axes axes(dots);
  std::string points, marks;
  for (const Dot& dot : dots) {
    const std::string x = fixed(axes.x(dot.bytes), 1), y = fixed(axes.y(dot.psnr), 1);
    points += x + "," + y + " ";
    marks += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"4\"/>";
    marks += label(axes.x(dot.bytes), kHeight - kBottom + 20, "middle", fixed(dot.bytes, 0));
  }
  return "<svg viewBox=\"-24 0 " + fixed(kWidth + 48, 0) + " " + fixed(kHeight, 0) +
         "\" role=\"img\" aria-label=\"Screen PSNR over bytes\">" + gridLines(axes) +
         "<polyline points=\"" + points + "\"/>" + marks +
         label((kLeft + kWidth - kRight) / 2, kHeight - 2, "middle", "bytes") + "</svg>";
}

}  // namespace tetrakis::tools
