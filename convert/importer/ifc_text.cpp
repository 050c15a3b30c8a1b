#include "convert/importer/ifc_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

namespace oriel {
namespace {

using Views = std::vector<std::string_view>;

// Of "#12=IFCWALL('a',#3,(1,2));" without the semicolon.
struct Statement {
  std::uint32_t id = 0;
  std::string_view type, arguments;  // "IFCWALL", "'a',#3,(1,2)"
  std::string_view whole;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n"), end = text.find_last_not_of(" \t\r\n");
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, end - begin + 1);
}

std::uint32_t reference(std::string_view text) {
  std::uint32_t id = 0;
  if (text.starts_with('#')) std::from_chars(text.data() + 1, text.data() + text.size(), id);
  return id;
}

double number(std::string_view text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Calls part(view) for what `between` divides, outside of strings and brackets.
template <class Part>
void divide(std::string_view text, char between, const Part& part) {
  int depth = 0;
  bool quoted = false;
  std::size_t from = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\'') quoted = !quoted;
    if (quoted) continue;
    if (c == between && (depth == 0 || between == ';')) part(text.substr(from, i - from)), from = i + 1, depth = 0;
    depth += (c == '(') - (c == ')');
  }
  if (!trimmed(text.substr(from)).empty()) part(text.substr(from));
}

// Of arguments "a,(b,c)": a and (b,c).
Views divided(std::string_view arguments) {
  Views out;
  divide(arguments, ',', [&](std::string_view part) { out.push_back(trimmed(part)); });
  return out;
}

// Of a list "(a,b)": a and b.
Views elements(std::string_view list) {
  list = trimmed(list);
  return list.starts_with('(') && list.ends_with(')') ? divided(list.substr(1, list.size() - 2)) : Views();
}

Statement statement_of(std::string_view whole) {
  Statement out{0, {}, {}, whole};
  const std::string_view text = trimmed(whole);
  const std::size_t equals = text.find('='), open = text.find('(');
  if (!text.starts_with('#') || equals == std::string_view::npos || open == std::string_view::npos || open < equals)
    return out;
  out.id = reference(text);
  out.type = trimmed(text.substr(equals + 1, open - equals - 1));
  out.arguments = text.substr(open + 1, std::max(text.rfind(')'), open + 1) - open - 1);
  return out;
}

// Elements that IFC 2x3 has not; it has all other attributes of a proxy, in its order.
constexpr std::string_view kNewElements =
    " IFCFURNITURE IFCSYSTEMFURNITUREELEMENT IFCSANITARYTERMINAL IFCLIGHTFIXTURE IFCLAMP IFCELECTRICAPPLIANCE "
    "IFCOUTLET "
    "IFCSHADINGDEVICE IFCCHIMNEY IFCGEOGRAPHICELEMENT IFCCIVILELEMENT IFCWALLELEMENTEDCASE IFCSLABSTANDARDCASE "
    "IFCSLABELEMENTEDCASE IFCDOORSTANDARDCASE IFCWINDOWSTANDARDCASE IFCBEAMSTANDARDCASE IFCCOLUMNSTANDARDCASE "
    "IFCPLATESTANDARDCASE IFCMEMBERSTANDARDCASE IFCAUDIOVISUALAPPLIANCE IFCCOMMUNICATIONSAPPLIANCE IFCPIPESEGMENT "
    "IFCDUCTSEGMENT IFCPIPEFITTING IFCDUCTFITTING IFCAIRTERMINAL IFCSPACEHEATER IFCSWITCHINGDEVICE IFCMEDICALDEVICE "
    "IFCVALVE IFCPUMP IFCFAN IFCTANK IFCBOILER IFCCABLECARRIERSEGMENT IFCCABLECARRIERFITTING "
    "IFCFIRESUPPRESSIONTERMINAL "
    "IFCWASTETERMINAL IFCSTACKTERMINAL IFCSOLARDEVICE IFCELECTRICDISTRIBUTIONBOARD ";

class Rewriter {
 public:
  explicit Rewriter(std::string_view text) : text_(text) {
    const std::string_view head = text.substr(0, text.find("DATA;"));
    new_ = head.find("'IFC4") != std::string_view::npos;
    divide(text, ';', [&](std::string_view whole) { collect(statement_of(whole)); });
  }

  ReadableIfc run() {
    ReadableIfc out;
    out.metres = metres();
    if (!new_) {
      out.text = text_;
      return out;
    }
    out_.reserve(text_.size() + text_.size() / 2);
    divide(text_, ';', [&](std::string_view whole) {
      rewrite(statement_of(whole));
      out_ += ";\n";
    });
    out.text = std::move(out_);
    return out;
  }

 private:
  void collect(const Statement& s) {
    last_ = std::max(last_, s.id);
    if (s.type == "IFCPRESENTATIONSTYLEASSIGNMENT") assignments_.insert(s.id);
    if (s.type == "IFCOWNERHISTORY") owner_ = s.id;
    if (s.type == "IFCUNITASSIGNMENT") units_ = s.arguments;
    if (s.type.starts_with("IFCCARTESIANPOINTLIST") || s.type.starts_with("IFCINDEXEDPOLYGONALFACE") ||
        s.type == "IFCCONVERSIONBASEDUNIT" || s.type == "IFCMEASUREWITHUNIT" || s.type == "IFCSIUNIT")
      by_id_[s.id] = s.arguments;
  }

  std::string_view argument(std::uint32_t id, std::size_t index) const {
    const auto at = by_id_.find(id);
    if (at == by_id_.end()) return {};
    const Views all = divided(at->second);
    return index < all.size() ? all[index] : std::string_view();
  }

  // Of a length unit that is so many of another.
  double metres() const {
    for (const std::string_view unit : elements(units_)) {
      if (argument(reference(unit), 1) != ".LENGTHUNIT." || argument(reference(unit), 0) == "*") continue;
      const std::uint32_t measure = reference(argument(reference(unit), 3));
      const std::string_view value = argument(measure, 0);
      const double factor = number(value.substr(std::min(value.find('(') + 1, value.size())));
      const std::string_view prefix = argument(reference(argument(measure, 1)), 2);
      const double of = prefix == ".MILLI." ? 1e-3 : prefix == ".CENTI." ? 1e-2 : prefix == ".DECI." ? 0.1 : 1;
      if (factor > 0 && std::isfinite(factor)) return factor * of;
    }
    return 1;
  }

  template <class... Args>
  std::uint32_t add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), "#{}=", ++last_);
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    out_ += ";\n";
    return last_;
  }

  static std::string references(const std::vector<std::uint32_t>& ids) {
    std::string out;
    for (const std::uint32_t id : ids) fmt::format_to(std::back_inserter(out), "{}#{}", out.empty() ? "" : ",", id);
    return out;
  }

  void rewrite(const Statement& s) {
    const Views arguments = s.type.starts_with("IFC") && needs(s) ? divided(s.arguments) : Views();
    if (s.type == "IFCSTYLEDITEM" && arguments.size() > 1 && !is_assigned(arguments[1])) {
      const std::uint32_t assignment = add("IFCPRESENTATIONSTYLEASSIGNMENT({})", arguments[1]);
      fmt::format_to(std::back_inserter(out_), "#{}=IFCSTYLEDITEM({},(#{}),$)", s.id, arguments[0], assignment);
    } else if (s.type == "IFCTRIANGULATEDFACESET" && arguments.size() > 3) {
      add_solid(s.id, arguments[0], elements(arguments[3]));
    } else if (s.type == "IFCPOLYGONALFACESET" && arguments.size() > 2) {
      Views faces;
      for (const std::string_view face : elements(arguments[2])) faces.push_back(argument(reference(face), 0));
      add_solid(s.id, arguments[0], faces);
    } else if (s.type == "IFCINDEXEDPOLYCURVE" && arguments.size() > 1) {
      add_curve(s.id, arguments);
    } else if (arguments.size() > 7 && is_new(s.type)) {
      fmt::format_to(std::back_inserter(out_), "#{}=IFCBUILDINGELEMENTPROXY({},#{}", s.id, arguments[0], owner_);
      for (std::size_t i = 2; i < 8; ++i) fmt::format_to(std::back_inserter(out_), ",{}", arguments[i]);
      out_ += ",$)";
    } else if (s.arguments.starts_with('\'') && s.arguments.size() > 27 &&
               s.arguments.substr(23, 4) == "',$,") {  // GlobalId: 22 characters
      const auto owner = static_cast<std::size_t>(s.arguments.data() - s.whole.data()) + 25;
      out_ += s.whole.substr(0, owner);
      fmt::format_to(std::back_inserter(out_), "#{}", owner_);
      out_ += s.whole.substr(owner + 1);
    } else {
      out_ += s.whole;
    }
  }

  static bool is_new(std::string_view type) {
    return kNewElements.find(fmt::format(" {} ", type)) != std::string_view::npos;
  }
  static bool needs(const Statement& s) {
    return s.type == "IFCSTYLEDITEM" || s.type.ends_with("FACESET") || s.type == "IFCINDEXEDPOLYCURVE" ||
           is_new(s.type);
  }
  bool is_assigned(std::string_view styles) const {
    const Views all = elements(styles);
    return !all.empty() && assignments_.contains(reference(all.front()));
  }

  // faces: lists of numbers, from 1, into a list of points.
  void add_solid(std::uint32_t id, std::string_view points, const Views& faces) {
    std::vector<std::uint32_t> corners, sides;
    for (const std::string_view point : elements(argument(reference(points), 0)))
      corners.push_back(add("IFCCARTESIANPOINT({})", point));
    for (const std::string_view face : faces) {
      std::vector<std::uint32_t> loop;
      for (const std::string_view corner : elements(face))
        if (const double at = number(corner); at >= 1 && at <= static_cast<double>(corners.size()))
          loop.push_back(corners[static_cast<std::size_t>(at) - 1]);
      if (loop.size() < 3) continue;
      const std::uint32_t bound = add("IFCPOLYLOOP(({}))", references(loop)),
                          outer = add("IFCFACEOUTERBOUND(#{},.T.)", bound);
      sides.push_back(add("IFCFACE((#{}))", outer));
    }
    const std::uint32_t shell = add("IFCCLOSEDSHELL(({}))", references(sides));
    fmt::format_to(std::back_inserter(out_), "#{}=IFCFACETEDBREP(#{})", id, shell);
  }

  // Lines, and arcs by three points on them.
  void add_curve(std::uint32_t id, const Views& arguments) {
    std::vector<std::vector<double>> points;
    for (const std::string_view point : elements(argument(reference(arguments[0]), 0))) {
      points.emplace_back();
      for (const std::string_view part : elements(point)) points.back().push_back(number(part));
    }
    std::vector<std::vector<double>> way;
    const auto go = [&](const std::vector<double>& to) {
      if (way.empty() || way.back() != to) way.push_back(to);
    };
    if (arguments[1] == "$")
      for (const auto& point : points) go(point);
    for (const std::string_view segment : arguments[1] == "$" ? Views() : elements(arguments[1])) {
      std::vector<std::vector<double>> through;
      const Views numbers = elements(segment.substr(std::min(segment.find('('), segment.size())));
      for (const std::string_view at : elements(numbers.empty() ? "" : numbers.front()))
        if (const double n = number(at); n >= 1 && n <= static_cast<double>(points.size()))
          through.push_back(points[static_cast<std::size_t>(n) - 1]);
      if (segment.starts_with("IFCARCINDEX") && through.size() == 3 && through[0].size() == 2) add_arc(through);
      for (const auto& point : through) go(point);
    }
    std::vector<std::uint32_t> ids;
    for (const auto& point : way) ids.push_back(add("IFCCARTESIANPOINT(({}))", fmt::join(point, ",")));
    fmt::format_to(std::back_inserter(out_), "#{}=IFCPOLYLINE(({}))", id, references(ids));
  }

  // Puts points of the circle between three of it, as chords of 15°, as fine as people see in plans.
  static void add_arc(std::vector<std::vector<double>>& p) {
    const double ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1], bx = p[2][0] - p[0][0], by = p[2][1] - p[0][1];
    const double twice = 2 * (ax * by - ay * bx), a = ax * ax + ay * ay, b = bx * bx + by * by;
    if (std::abs(twice) < 1e-9 * (a + b)) return;                               // a straight line
    const double x = (by * a - ay * b) / twice, y = (ax * b - bx * a) / twice;  // centre from p[0]
    const double radius = std::hypot(x, y), begin = std::atan2(-y, -x);
    double turn = std::atan2(by - y, bx - x) - begin;
    const double full = 2 * std::numbers::pi;
    if (twice > 0)
      turn = turn < 0 ? turn + full : turn;
    else
      turn = turn > 0 ? turn - full : turn;
    const int steps = std::max(2, static_cast<int>(std::ceil(std::abs(turn) / (full / 24))));
    std::vector<std::vector<double>> out = {p[0]};
    for (int i = 1; i < steps; ++i) {
      const double angle = begin + turn * i / steps;
      out.push_back({p[0][0] + x + radius * std::cos(angle), p[0][1] + y + radius * std::sin(angle)});
    }
    out.push_back(p[2]);
    p = std::move(out);
  }

  std::string_view text_, units_;
  bool new_ = false;
  std::uint32_t last_ = 0, owner_ = 1;
  std::set<std::uint32_t> assignments_;
  std::map<std::uint32_t, std::string_view> by_id_;
  std::string out_;
};

}  // namespace

ReadableIfc readable_ifc(std::string_view text) {
  return Rewriter(text).run();
}

}  // namespace oriel
