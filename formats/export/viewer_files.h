// The viewer as web/build.mjs made it: parts of the program, so that it needs no files at run time.
#pragma once

#include <string_view>

namespace oriel {

// "app.js", "index.html", "offline.js", "style.css", "icon.svg", "licences.txt"; empty for another name.
std::string_view viewer_file(std::string_view name);

}  // namespace oriel
