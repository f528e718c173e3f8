#include "lenses/lens_io/sdf.hpp"

#include <algorithm>
#include <cmath>

#include "lenses/lens_io/json_document.hpp"
#include "lenses/lens_io/json_text.hpp"
#include "lenses/lens_io/sag_text.hpp"
#include "tracking/input_error.hpp"

namespace lenses {
namespace io {
namespace {

constexpr const char* kForm = "must be 1;R|L|B;F|B;columns;rows;width_mm;height_mm;0";

std::size_t place_count(std::string_view text, const OmaJob& job, std::size_t line, const char* what) {
  const auto value = number_in(text);
  if (!value || *value != std::floor(*value) || *value < double{kFewestPlaces} || *value > double{kMostPlaces}) {
    job.fail(line, "has " + in_quotes(text) + " " + what + "; " + std::to_string(kFewestPlaces) + " to " +
                       std::to_string(kMostPlaces) + " are allowed");
  }
  return static_cast<std::size_t>(*value);
}

double size_mm(std::string_view text, const OmaJob& job, std::size_t line, const char* what) {
  const auto value = number_in(text);
  if (!value || !(*value > 0.0) || *value > kMostSizeMm) {
    job.fail(line, "has a " + std::string(what) + " of " + in_quotes(text) + "; above 0 and up to " +
                       number_text(kMostSizeMm) + " mm is allowed");
  }
  return *value;
}

struct Header {
  SdfSurface surface;
  GridReader grid;
};

Header read_header(const OmaJob& job, std::size_t line, RowOrder rows) {
  std::vector<std::string_view> fields = split(job.lines[line].value(), ';');
  for (std::string_view& field : fields) field = trimmed(field);
  if (fields.size() < 7 || fields.size() > 8) {
    job.fail(line, "has " + std::to_string(fields.size()) + " fields; " + kForm);
  }
  if (fields[0] != "1") job.fail(line, "is of format " + in_quotes(fields[0]) + "; only format 1, heights, is read");
  const auto is_one_of = [](std::string_view field, std::string_view letters) {
    return field.size() == 1 && letters.find(field[0]) != std::string_view::npos;
  };
  if (!is_one_of(fields[1], "RLB") || !is_one_of(fields[2], "FB"))
    job.fail(line, std::string("is of no known side; ") + kForm);
  if (fields.size() == 8 && !fields[7].empty() && number_in(fields[7]) != 0.0) {
    job.fail(line, "ends in " + in_quotes(fields[7]) + "; only 0 is read");
  }
  const std::size_t columns = place_count(fields[3], job, line, "columns");
  const std::size_t row_count = place_count(fields[4], job, line, "rows");
  if (columns * row_count > kMostSamples) {
    job.fail(line, "has " + std::to_string(columns * row_count) + " heights; up to " + std::to_string(kMostSamples) +
                       " are allowed");
  }
  Header header{
      {}, {columns, row_count, size_mm(fields[5], job, line, "width"), size_mm(fields[6], job, line, "height"), rows}};
  header.surface.line = line;
  if (fields[1] != "B") header.surface.side = fields[1] == "R" ? Side::right : Side::left;
  header.surface.face = fields[2] == "F" ? Face::front : Face::back;
  return header;
}

void finish(Header& header, const OmaJob& job, std::vector<SdfSurface>& surfaces) {
  if (header.grid.rows_taken() < header.grid.rows()) {
    job.fail(header.surface.line, "announces " + std::to_string(header.grid.rows()) + " rows; " +
                                      std::to_string(header.grid.rows_taken()) + " ZZ records follow");
  }
  header.surface.samples = header.grid.finish();
  surfaces.push_back(std::move(header.surface));
}

bool fits(const SdfSurface& surface, const SagReading& reading) {
  const bool side = !reading.side || !surface.side || *surface.side == *reading.side;
  return side && (!reading.face || surface.face == *reading.face);
}

}  // namespace

std::vector<SdfSurface> sdf_surfaces(const OmaJob& job, RowOrder rows) {
  std::vector<SdfSurface> surfaces;
  std::optional<Header> open;
  for (std::size_t i = 0; i < job.lines.size(); ++i) {
    const std::string_view label = job.lines[i].label();
    if (label == "SURFMT") {
      if (open) finish(*open, job, surfaces);
      open.emplace(read_header(job, i, rows));
    } else if (label == "ZZ") {
      if (!open) job.fail(i, "stands before any SURFMT record, which must announce it");
      open->grid.take_row(job.lines[i].value(), ';', {job.file, i + 1, "ZZ"});
    }
  }
  if (open) finish(*open, job, surfaces);
  return surfaces;
}

}  // namespace io

SagFile parse_sdf(std::string_view text, const std::string& file, const SagReading& reading) {
  std::vector<io::SdfSurface> surfaces = io::sdf_surfaces(io::parse_oma(text, file), reading.rows);
  if (surfaces.empty()) throw tracking::InputError(file, "SURFMT", "is missing; a surface begins with this record");
  // A lone surface is the one that is meant, whatever it calls itself.
  if (surfaces.size() > 1) std::erase_if(surfaces, [&](const auto& surface) { return !io::fits(surface, reading); });
  if (surfaces.size() != 1) {
    throw tracking::InputError(file, "SURFMT",
                               "appears for several surfaces, " + std::to_string(surfaces.size()) +
                                   " of them of the side and surface asked for; name side and surface of one");
  }
  return {surfaces.front().side, surfaces.front().face, std::move(surfaces.front().samples)};
}

std::string to_sdf(const SagGrid& grid, const SagWriting& writing) {
  std::string text = std::string("SURFMT=1;") + (writing.side == Side::right ? "R;" : "L;") +
                     (writing.face == Face::front ? "F;" : "B;") + std::to_string(grid.columns) + ";" +
                     std::to_string(grid.rows) + ";" + io::number_text(io::rounded(1e3 * grid.width, 12)) + ";" +
                     io::number_text(io::rounded(1e3 * grid.height, 12)) + ";0\r\n";
  for (const std::string& row : io::grid_rows(grid, writing, ';')) text += "ZZ=" + row + "\r\n";
  return text;
}

}  // namespace lenses
