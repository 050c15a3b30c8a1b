// The parts of a page; each is empty where the pack has nothing to say about it.
#pragma once

#include <string>

#include "formats/export/report.h"

namespace oriel::report {

// What was asked and what came out: the plan's errors, omissions, light, and everything else that it and the provenance
// say.
// What was warned of and found, and the places that are worst, with pictures of them.
std::string findings_html(const Pack& pack, const Limits& limits);
std::string errors_html(const Pack& pack, const Limits& limits);
std::string records_html(const Pack& pack, const Limits& limits);

std::string lightmaps_html(const Pack& pack, const Limits& limits);
std::string surfaces_html(const Pack& pack, const Limits& limits);
std::string reflections_html(const Pack& pack, const Limits& limits);
std::string materials_html(const Pack& pack, const Limits& limits);

}  // namespace oriel::report
