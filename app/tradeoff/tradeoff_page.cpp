#include "app/tradeoff/tradeoff_page.hpp"

#include <algorithm>
#include <cmath>

#include "app/report/html.hpp"
#include "app/report/text.hpp"
#include "app/tradeoff/tradeoff_advice.hpp"

namespace app {
namespace {

std::string cell(const std::string& text) {
  return "<td>" + html_escaped(text) + "</td>";
}

std::string digits(std::optional<double> value) {
  return value && std::isfinite(*value) ? format("%.3g", *value) : "-";
}

std::string table(const TradeoffReport& report) {
  std::string out =
      "<table><tr><th>setting</th><th>what it is</th><th>samples</th><th>median ms</th><th>min</th><th>max</th>"
      "<th>RMS error</th><th>PSNR dB</th><th>FLIP</th><th>power, D (99th percentile)</th>"
      "<th>astigmatism, D (99th percentile)</th><th>stages, ms</th></tr>\n";
  for (const TradeoffRow& row : report.rows) {
    std::string stages;
    for (const auto& [name, ms] : row.stages) {
      stages += (stages.empty() ? "" : ", ") + name + " " + format("%.2f", ms);
    }
    out += std::string(row.efficient ? "<tr class=\"efficient\">" : "<tr>") + cell(row.setting) + cell(row.what) +
           cell(std::to_string(row.samples)) + cell(number(row.ms.median, 2)) + cell(number(row.ms.min, 2)) +
           cell(number(row.ms.max, 2)) + cell(digits(row.rmse)) + cell(number(row.psnr_db, 2)) +
           cell(number(row.flip, 4)) + cell(digits(row.power_error_D_p99)) + cell(digits(row.astigmatism_error_D_p99)) +
           cell(stages) + "</tr>\n";
  }
  return out + "</table>\n<p>Shaded: efficient, nothing measured here is both as fast and as good.</p>\n";
}

std::string histogram(const render::IterationHistogram& iterations) {
  if (iterations.iterated() == 0) {
    return "";
  }
  std::string out =
      "<h2>Steps of Newton's method for a surface</h2>\n<p>Chief rays of every pixel, both surfaces, to single "
      "precision; planes and spheres take none.</p>\n<table><tr><th>steps</th><th>surfaces</th><th></th></tr>\n";
  const auto line = [&](const std::string& name, std::size_t count) {
    if (count > 0) {
      const double share = static_cast<double>(count) / static_cast<double>(iterations.iterated());
      out += "<tr>" + cell(name) + cell(std::to_string(count)) +
             format(
                 "<td style=\"text-align: left\"><div style=\"background: #0072b2; height: 1em; width: "
                 "%.2fem\"></div></td></tr>\n",
                 30.0 * share);
    }
  };
  for (std::size_t n = 0; n < iterations.surfaces.size(); ++n) {
    line(std::to_string(n), iterations.surfaces[n]);
  }
  line("searched", iterations.searched);
  return out + "</table>\n";
}

std::string figure(const std::string& file, const std::string& caption) {
  return "<figure><img src=\"" + html_escaped(file) + "\" alt=\"" + html_escaped(caption) + "\"><figcaption>" +
         html_escaped(caption) + "</figcaption></figure>\n";
}

std::string pictures(const TradeoffReport& report) {
  std::string out;
  for (const TradeoffRow& row : report.rows) {
    out += "<h3 id=\"" + html_escaped(row.setting) + "\">" + html_escaped(row.setting + ": " + row.what) + "</h3>\n";
    const std::string name = row.setting + format(", %.2f ms", row.ms.median);
    if (!row.rmse) {
      out += figure(picture_file(row), name + "; a map, with no picture to compare");
      continue;
    }
    out += figure(kReferenceFile, "reference") +
           figure(picture_file(row), name + ", " + number(row.psnr_db, 2) + " dB, FLIP " + number(row.flip, 4)) +
           figure(difference_file(row), format("difference, %.0f times", kDifferenceGain));
  }
  return out;
}

}  // namespace

std::string picture_file(const TradeoffRow& row) {
  return "picture_" + row.setting + ".png";
}

std::string difference_file(const TradeoffRow& row) {
  return "difference_" + row.setting + ".png";
}

render::Image8 difference_image(const render::Image8& image, const render::Image8& reference) {
  render::Image8 out = image;
  for (std::size_t i = 0; i < out.rgb.size(); ++i) {
    const double difference = std::abs(int{image.rgb[i]} - int{reference.rgb[i]});
    out.rgb[i] = static_cast<std::uint8_t>(std::min(kDifferenceGain * difference, 255.0));
  }
  return out;
}

std::string tradeoff_page(const TradeoffReport& report) {
  std::string body =
      "<style>.efficient { background: #e4f0dc } figure img { width: 30em; image-rendering: auto } "
      "td:nth-child(1), td:nth-child(2), td:nth-child(12) { text-align: left }</style>\n"
      "<h1>What accuracy costs in time</h1>\n<p>" +
      html_escaped(report.scene) + "; wearer " + html_escaped(report.wearer) + "; spectacles " +
      html_escaped(report.spectacles) +
      format("; %dx%d pixels, %.3g degrees high; ", report.width, report.height, report.fov_deg) +
      html_escaped(report.device) + "</p>\n<ul>\n";
  for (const std::string& sentence : advice(report)) {
    body += "<li>" + html_escaped(sentence) + "</li>\n";
  }
  body += "</ul>\n<p><img src=\"tradeoff.svg\" alt=\"Error against time, both axes logarithmic\"></p>\n";
  body += format(
      "<p>The reference traces %d rays a pixel through the real lens in double precision, spread over pupil and pixel "
      "with another pattern than the settings use. Times are the device's own, medians of rounds in which all settings "
      "took turns. RMS error and PSNR compare display values as fractions of full scale. FLIP (Andersson et al. 2020) "
      "is the mean difference that a viewer sees when flipping between the two, 0 to 1, at %.1f pixels a degree. Power "
      "and astigmatism compare each pixel's wavefront at the pupil with the double-precision tracer's for the same "
      "direction and distance: 99 of 100 pixels differ by no more.</p>\n",
      report.reference_samples, report.pixels_per_degree);
  for (const std::string& reason : report.left_out) {
    body += "<p>Left out: " + html_escaped(reason) + "</p>\n";
  }
  body += table(report) + histogram(report.iterations) + "<h2>Pictures</h2>\n" + pictures(report) +
          "<p>Every number: <a href=\"tradeoff.csv\">tradeoff.csv</a>.</p>\n";
  return html_page("What accuracy costs in time", body);
}

}  // namespace app
