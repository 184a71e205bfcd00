// SPDX-License-Identifier: Apache-2.0
// The report as one HTML page that needs no other file. What it shows is measured here; how, page/
// says, with D3 (https://d3js.org, BSD-3-Clause).

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/tools/files/pictures/picture_formats.hpp"
#include "apps/tools/files/text.hpp"
#include "apps/tools/report/page_data.hpp"
#include "apps/tools/report/report.hpp"
#include "base/shown_text.hpp"

namespace tetrakis::tools {
namespace {

constexpr int kJpegQuality = 92;

constexpr unsigned char kD3[] = {
#include "apps/tools/report/d3.inc"
};
constexpr unsigned char kScript[] = {
#include "apps/tools/report/page_script.inc"
};
constexpr unsigned char kStyle[] = {
#include "apps/tools/report/page_style.inc"
};

template <size_t N>
std::string textOf(const unsigned char (&bytes)[N]) {
  return {bytes, bytes + N};
}

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : shownLines(text)) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else if (c == '"')
      html += "&quot;";
    else
      html += c;
  }
  return html;
}

std::string decibels(std::optional<double> psnr) {
  if (!psnr || std::isnan(*psnr) || *psnr == -INFINITY) return "–";
  return std::isinf(*psnr) ? "exact" : fixed(*psnr, 2) + " dB";
}

std::string cell(const std::string& text) {
  return "<td>" + text + "</td>";
}

std::string tableRow(const ReportRow& row) {
  const Measurement& m = row.measurement;
  return "<tr>" + cell("1/" + std::to_string(row.divisor)) + cell(std::to_string(m.bytes)) +
         cell(std::to_string(m.geometry_bytes)) + cell(std::to_string(m.texture_bytes)) +
         cell(m.triangles ? std::to_string(*m.triangles) : "–") +
         cell(m.heights ? fixed(m.heights->rmse, 3) : "–") +
         cell(m.heights ? fixed(m.heights->max_error, 3) : "–") +
         cell(m.heights ? decibels(m.heights->psnr) : "–") + cell(decibels(m.texture_psnr)) +
         cell(decibels(m.screen_psnr)) + "</tr>\n";
}

std::string figuresTable(const std::vector<ReportRow>& rows) {
  std::string html =
      "<div "
      "class=\"scroll\"><table>\n<tr><th>cut</th><th>bytes</th><th>geometry</th><th>texture</th>"
      "<th>triangles</th><th>height RMSE</th><th>height max</th><th>height PSNR</th>"
      "<th>texture PSNR</th><th>screen PSNR</th></tr>\n";
  for (const ReportRow& row : rows) html += tableRow(row);
  return html + "</table></div>\n";
}

Result<std::string> figure(const Picture& picture, const std::string& caption) {
  const Result<std::vector<std::byte>> jpeg = encodeJpeg(imageOf(picture), kJpegQuality);
  if (!jpeg.ok()) return jpeg.status();
  const auto formats = pictureFormats();
  if (!formats.ok()) return formats.status();
  return "<figure><img alt=\"" + caption + "\" src=\"data:image/jpeg;base64," +
         (*formats)->base64(*jpeg) + "\"><figcaption>" + caption + "</figcaption></figure>\n";
}

std::string caption(const ReportRow& row, size_t camera) {
  return "1/" + std::to_string(row.divisor) + ": " + std::to_string(row.measurement.bytes) +
         " bytes, " + decibels(row.measurement.camera_psnr[camera]);
}

/// The original, then every cut, as one camera sees them.
Result<std::string> pictures(const Report& report, size_t camera) {
  std::string html = "<div data-camera class=\"plates\">\n";
  const Result<std::string> original = figure(report.originals[camera], "original");
  if (!original.ok()) return original;
  html += *original;
  for (const ReportRow& row : report.rows) {
    const Result<std::string> cut = figure(row.measurement.pictures[camera], caption(row, camera));
    if (!cut.ok()) return cut;
    html += *cut;
  }
  return html + "</div>\n";
}

constexpr const char* kSlider = R"html(<section><h2>Beside the original</h2>
<p>Pull the handle: the original is on the left, the cut of the stream on the right.</p>
<div class="buttons" id="cameras"></div><div class="buttons" id="cuts"></div>
<div class="slider"><img class="original" alt=""><img class="cut" alt=""><i></i>
<span class="left">original</span><span class="right"></span>
<input type="range" min="0" max="100" step="0.1" value="50" aria-label="original or cut"></div>
)html";

constexpr const char* kPaths = R"html(<div class="legend">
<span><i style="border-color: var(--best)"></i>best pairs (hull of all)</span>
<span><i class="dashed" style="border-color: var(--greedy)"></i>marginal analysis</span>
<span><i style="border-color: var(--shipped)"></i>the stream's own order</span></div>
)html";

constexpr const char* kCurves = R"html(<div class="legend">
<span><i style="border-color: var(--best)"></i>best pairs (hull of all)</span>
<span><i style="border-color: var(--shipped)"></i>cuts of the stream</span></div>
)html";

constexpr const char* kComponentLegend = R"html(<div class="legend">
<span><i class="area" style="background: var(--heights)"></i>heights</span>
<span><i class="area" style="background: var(--texture)"></i>texture</span></div>
)html";

/// What a chart is called, what it says, and its legend.
struct ChartText {
  std::string title, text;
  const char* legend;
};

std::string chart(const char* id, const ChartText& words) {
  return "<section><h2>" + words.title + "</h2><p>" + words.text +
         "</p><div class=\"chart\" id=\"" + id + "\"></div>" + words.legend + "</section>\n";
}

/// The charts of the plane, which the script fills.
std::string charts(const PairPlane& plane) {
  const std::string pairs = std::to_string(plane.psnr.size());
  const std::string rates = "All " + pairs + " pairs of " + std::to_string(plane.heights.size()) +
                            " prefixes of the heights and " +
                            std::to_string(plane.textures.size()) +
                            " of the texture; a thin line is one texture.";
  const std::string path =
      "Lines of equal screen PSNR, in dB. Marginal analysis gave up bytes in " +
      std::to_string(plane.greedy.size() - 1) + " steps, and looked at " +
      std::to_string(plane.looked) + " of the " + pairs + " pairs.";
  return "<div class=\"pair\">\n" + chart("rates", {"Rate and distortion", rates, kCurves}) +
         chart("split", {"Where the bytes go",
                         "Heights and texture in the stream's first bytes, up to all of them.",
                         kComponentLegend}) +
         chart("iso-psnr", {"Equal PSNR", path, kPaths}) +
         chart("iso-bytes",
               {"Equal bytes", "Lines of equal bytes of heights and texture together.", kPaths}) +
         "</div>\n";
}

std::string fact(const std::string& value, const char* what) {
  return "<div><b>" + value + "</b><span>" + what + "</span></div>";
}

std::string facts(const Report& report) {
  if (report.rows.empty()) return "";
  const Measurement& whole = report.rows.front().measurement;
  return "<div class=\"facts\">" + fact(std::to_string(whole.bytes), "bytes") +
         fact(std::to_string(whole.geometry_bytes), "of heights") +
         fact(std::to_string(whole.texture_bytes), "of texture") +
         fact(decibels(whole.screen_psnr), "on the screen") + "</div>\n";
}

std::string meshPlans(const std::vector<MeshPlan>& meshes) {
  if (meshes.empty()) return "";
  std::string html =
      "<section><h2>Meshes from above</h2><p>The dot is the viewer, or the side that he is "
      "on.</p><div class=\"plates\">\n";
  for (size_t i = 0; i < meshes.size(); ++i)
    html += "<figure><div class=\"chart\" id=\"mesh-" + std::to_string(i) +
            "\"></div><figcaption>" + escaped(meshes[i].caption) + "</figcaption></figure>\n";
  return html + "</div></section>\n";
}

Result<std::string> galleries(const Report& report) {
  std::string html;
  for (const Gallery& gallery : report.galleries) {
    html += "<section><h2>" + escaped(gallery.title) + "</h2><p>" + escaped(gallery.text) +
            "</p><div class=\"plates\">\n";
    for (const Gallery::Plate& plate : gallery.plates) {
      const Result<std::string> shown = figure(plate.picture, escaped(plate.caption));
      if (!shown.ok()) return shown;
      html += *shown;
    }
    html += "</div></section>\n";
  }
  return html;
}

}  // namespace

Result<std::string> renderPage(const Report& report) {
  const std::string title = escaped(report.title);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<style>\n" +
      textOf(kStyle) + "</style>\n<title>" + title + "</title>\n</head>\n<body><main>\n<h1>" +
      title + "</h1>\n";
  html +=
      "<p>One stream, cut at fractions of its bytes. Height errors are in the unit of the "
      "stream; geometry and texture are payload bytes.</p>\n";
  html += facts(report) + kSlider;
  for (size_t camera = 0; camera < report.cameras.size(); ++camera) {
    const Result<std::string> shown = pictures(report, camera);
    if (!shown.ok()) return shown;
    html += *shown;
  }
  html += "</section>\n";
  if (report.plane) html += charts(*report.plane);
  html += "<section><h2>Figures</h2>\n" + figuresTable(report.rows) + "</section>\n";
  html += meshPlans(report.meshes);
  const Result<std::string> more = galleries(report);
  if (!more.ok()) return more;
  return html + *more + "</main>\n<script>\n" + textOf(kD3) +
         "</script>\n<script>\nconst report = " + pageData(report) + ";\n" + textOf(kScript) +
         "</script>\n</body>\n</html>\n";
}

}  // namespace tetrakis::tools
