#include "bake/reference/table.h"

#include <iterator>

#include "formats/core/color.h"

namespace oriel {

std::string lux_csv(std::span<const MeasurePoint> points, std::span<const PointIlluminance> results) {
  std::string csv =
      "x,y,z,nx,ny,nz,E,E_r,E_g,E_b,direct,direct_r,direct_g,direct_b,indirect,indirect_r,indirect_g,indirect_b,"
      "error,error_r,error_g,error_b\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const DVec3 &p = points[i].position, &n = points[i].normal;
    const PointIlluminance& r = results[i];
    auto out = std::back_inserter(csv);
    fmt::format_to(out, "{},{},{},{},{},{}", p.x, p.y, p.z, n.x, n.y, n.z);
    const auto four = [&](double y, const DVec3& rgb) {
      fmt::format_to(out, ",{:.6g},{:.6g},{:.6g},{:.6g}", y, rgb.r, rgb.g, rgb.b);
    };
    for (const DVec3& rgb : {r.direct + r.indirect, r.direct, r.indirect}) four(luminance(rgb), rgb);
    four(r.luminance_error, r.standard_error);
    csv += '\n';
  }
  return csv;
}

}  // namespace oriel
