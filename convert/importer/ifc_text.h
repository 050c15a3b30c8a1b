// IFC 4 in the words of IFC 2x3, which assimp reads.
#pragma once

#include <string>
#include <string_view>

namespace oriel {

struct ReadableIfc {
  std::string text;
  double metres = 1;  // of what assimp takes for a metre: it does not know feet and inches
};

// Of IFC 4: styles get the assignment around them, tessellated and polygonal face sets become faceted solids, indexed
// curves polylines, and elements that came with IFC 4 become proxies; of everything else, what is optional there is
// filled. IFC 2x3 stays as it is.
ReadableIfc readable_ifc(std::string_view text);

}  // namespace oriel
