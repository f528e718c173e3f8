#include "lenses/design/progressive.hpp"

#include "lenses/design/progressive_report.hpp"

namespace lenses {

ProgressiveDesign design_progressive(const ProgressiveConfig& config, const DesignProgress& progress) {
  config.validate();
  ProgressiveDesign design{closed_form_progressive(config), {}};
  design.report = report_progressive(design.surface, config);
  if (progress) progress(1.0);
  return design;
}

}  // namespace lenses
