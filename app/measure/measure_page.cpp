#include "app/measure/measure_page.hpp"

#include <numbers>

#include "app/report/html.hpp"
#include "app/report/text.hpp"

namespace app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string cells(std::initializer_list<std::string> values) {
  std::string out;
  for (const std::string& value : values) {
    out += std::string("<td>") + html_escaped(value) + "</td>";
  }
  return out;
}

std::string readings_table(const MeasureReport& report) {
  std::string out =
      "<table><tr><th>point</th><th>on the stop</th><th>x mm</th><th>y mm</th><th>sphere D</th><th>cylinder D</th>"
      "<th>axis</th><th>prism pd</th><th>base</th></tr>\n";
  for (const lenses::PointReading& point : report.readings.points) {
    out += std::string("<tr>") +
           cells({name(point.point), name(point.side), number(1e3 * point.at.x, 2), number(1e3 * point.at.y, 2)});
    if (point.reading.status == lenses::RayStatus::ok) {
      const lenses::Refraction found = sphere_cylinder(point.reading.power, report.form);
      const lenses::Prism prism = lenses::to_prism(point.reading.prism);
      out += cells({signed_number(found.sphere, 2), signed_number(found.cylinder, 2), number(axis_degrees(found), 1),
                    number(prism.magnitude, 2), number(base_degrees(prism), 0)});
    } else {
      out += std::string("<td colspan=\"5\">") + name(point.reading.status) + "</td>";
    }
    out += "</tr>\n";
  }
  out += "</table>\n";
  if (report.readings.addition) {
    out += std::string("<p>Addition ") + signed_number(report.readings.addition, 2) + " D, from the " +
           name(report.readings.addition_side) + " vertex powers.</p>\n";
  }
  return out;
}

std::string verdict_table(const MeasureReport& report) {
  std::string out = std::string("<p>") + html_escaped(verdict_line(report)) + "</p>\n";
  if (!report.verdict) {
    return out;
  }
  out +=
      "<table><tr><th>tolerance</th><th>unit</th><th>measured</th><th>target</th><th>difference</th><th>limit</th>"
      "<th></th></tr>\n";
  for (const lenses::Check& check : report.verdict->checks) {
    out += std::string(check.pass ? "<tr>" : "<tr class=\"fail\">") +
           cells({check.tolerance, check.unit, number(check.measured, 2), number(check.target, 2),
                  signed_number(check.difference, 3), number(check.limit, 3), check.pass ? "pass" : "FAIL"}) +
           "</tr>\n";
  }
  return out + "</table>\n";
}

std::string thickness_words(const MeasureReport& report) {
  const auto mm = [](std::optional<double> metres) {
    return number(metres ? std::optional<double>(1e3 * *metres) : std::nullopt, 2);
  };
  std::string out = std::string("<p>Index ") + number(report.lens.index, 3) + ", blank " +
                    number(1e3 * report.lens.diameter, 1) + " mm, centre " + mm(report.centre_thickness) + " mm";
  if (report.edge) {
    out += std::string(report.lens.outline.empty() ? ", rim " : ", edge of the outline ") +
           mm(report.edge->least.thickness) + " mm (at " + number(1e3 * report.edge->least.at.x, 1) + ", " +
           number(1e3 * report.edge->least.at.y, 1) + ") to " + mm(report.edge->greatest.thickness) + " mm (at " +
           number(1e3 * report.edge->greatest.at.x, 1) + ", " + number(1e3 * report.edge->greatest.at.y, 1) + ")";
  }
  return out + ".</p>\n";
}

}  // namespace

std::string measure_page(const MeasureReport& report, const WornSetting& worn, std::span<const NamedPicture> pictures) {
  std::string body =
      std::string("<h1>") + html_escaped(report.source) + "</h1>\n" + thickness_words(report) +
      "<h2>Lensmeter</h2>\n<p>The beam is normal to the surface on the stop at the point; axes and "
      "bases are TABO, as the examiner sees them.</p>\n" +
      readings_table(report) + "<h2>Verdict</h2>\n" + verdict_table(report) +
      "<h2>Maps</h2>\n<p>As worn: "
      "the eye turns about its centre of rotation; powers at the vertex sphere of " +
      number(1e3 * worn.vertex_sphere, 1) + " mm. Working distance: infinity above " +
      number(kDegrees * worn.far_pitch, 1) + " degrees of pitch, " + number(1e2 * worn.working_distance, 0) +
      " cm from the vertex sphere below " + number(kDegrees * worn.near_pitch, 1) +
      " degrees, its vergence changing smoothly between. Cross: fitting cross; D: distance point; N: near "
      "point; P: prism point; the heavy line is the frame's outline or a segment's edge; grey: no "
      "reading.</p>\n";
  for (const NamedPicture& picture : pictures) {
    body += std::string("<figure><img src=\"") + html_escaped(picture.file) + "\" width=\"600\" alt=\"" +
            html_escaped(picture.caption) + "\"><figcaption>" + html_escaped(picture.caption) +
            "</figcaption></figure>\n";
  }
  body +=
      "<p>Every number: <a href=\"readings.csv\">readings.csv</a>, " +
      std::string(report.verdict ? "<a href=\"verdict.csv\">verdict.csv</a>, " : "") +
      "<a href=\"lens_map.csv\">lens_map.csv</a>, <a href=\"worn_map.csv\">worn_map.csv</a>. A verdict judges the lens "
      "against its tolerances, not what it is like to wear. Not a medical device.</p>\n";
  return html_page(report.source, body);
}

}  // namespace app
