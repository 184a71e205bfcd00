// SPDX-License-Identifier: Apache-2.0
// The report as one HTML page that needs no other file.
#include <OpenImageIO/strutil.h>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/files/text.hpp"
#include "tools/report/report.hpp"

namespace tetrakis::tools {
namespace {

constexpr int kJpegQuality = 92;

constexpr const char* kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; background: #fafaf8; max-width: 1240px;
       margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin-top: 2em; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .25em .9em; text-align: right; border-bottom: 1px solid #ddd; }
th { font-weight: 600; }
svg { width: 100%; max-width: 688px; font-size: 12px; fill: #555; }
svg polyline { fill: none; stroke: #2a6f97; stroke-width: 2; }
svg circle { fill: #2a6f97; } svg .grid { stroke: #ddd; }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(360px, 1fr)); gap: 1em; }
figure { margin: 0; } figure img { width: 100%; display: block; }
figcaption { color: #555; font-size: .9em; }
</style>
)";

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
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
      "<table>\n<tr><th>cut</th><th>bytes</th><th>geometry</th><th>texture</th>"
      "<th>triangles</th><th>height RMSE</th><th>height max</th><th>height PSNR</th>"
      "<th>texture PSNR</th><th>screen PSNR</th></tr>\n";
  for (const ReportRow& row : rows) html += tableRow(row);
  return html + "</table>\n";
}

ImageFile withoutAlpha(const Picture& picture) {
  ImageFile image{picture.width, picture.height, 3, TKS_U8, {}};
  image.data.reserve(picture.rgba.size() / 4 * 3);
  for (size_t i = 0; i < picture.rgba.size(); i += 4)
    for (size_t channel = 0; channel < 3; ++channel)
      image.data.push_back(std::byte{picture.rgba[i + channel]});
  return image;
}

Result<std::string> figure(const Picture& picture, const std::string& caption) {
  const Result<std::vector<std::byte>> jpeg = encodeJpeg(withoutAlpha(picture), kJpegQuality);
  if (!jpeg.ok()) return jpeg.status();
  const OIIO::string_view bytes(reinterpret_cast<const char*>(jpeg->data()), jpeg->size());
  return "<figure><img alt=\"" + caption + "\" src=\"data:image/jpeg;base64," +
         OIIO::Strutil::base64_encode(bytes) + "\"><figcaption>" + caption +
         "</figcaption></figure>\n";
}

std::string caption(const ReportRow& row, size_t camera) {
  return "1/" + std::to_string(row.divisor) + ": " + std::to_string(row.measurement.bytes) +
         " bytes, " + decibels(row.measurement.camera_psnr[camera]);
}

/// The original, then every cut, as one camera sees them.
Result<std::string> pictures(const Report& report, size_t camera) {
  std::string html =
      "<h2>" + escaped(report.cameras[camera].name) + "</h2>\n<div class=\"pictures\">\n";
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

}  // namespace

Result<std::string> renderPage(const Report& report) {
  const std::string title = escaped(report.title);
  std::string html = kHead;
  html += "<title>" + title + "</title>\n</head>\n<body>\n<h1>" + title + "</h1>\n";
  html +=
      "<p>One stream, cut at fractions of its bytes. Height errors are in the unit of the "
      "stream; geometry and texture are payload bytes.</p>\n";
  html += figuresTable(report.rows);
  html += "<h2>Screen PSNR over bytes</h2>\n" + plotScreenPsnr(report.rows) + "\n";
  for (size_t camera = 0; camera < report.cameras.size(); ++camera) {
    const Result<std::string> shown = pictures(report, camera);
    if (!shown.ok()) return shown;
    html += *shown;
  }
  return html + "</body>\n</html>\n";
}

}  // namespace tetrakis::tools
