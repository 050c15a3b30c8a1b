#include "trade/html.h"

#include <algorithm>
#include <thread>

#include "formats/core/text.h"
#include "trade/front.h"
#include "trade/plot.h"
#include "trade/table.h"
#include "trade/thumbnails.h"

namespace oriel::trade {
namespace {

constexpr std::uint32_t kWidestThumbnail = 240;

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{0}: cost against error</title>
<style>
body {{ font: 15px/1.5 system-ui, sans-serif; color: #1a1a1a; max-width: 1180px; margin: 2rem auto; padding: 0 1rem }}
h1 {{ font-size: 1.6rem; margin: 0 0 .3rem }} h2 {{ font-size: 1.15rem; margin: 2.2rem 0 .6rem }}
p {{ max-width: 70ch; margin: .4rem 0 }} .quiet {{ color: #555; font-size: .9rem }}
.plots {{ display: grid; grid-template-columns: repeat(auto-fit, minmax(440px, 1fr)); gap: 1rem }}
svg {{ width: 100%; height: auto; border: 1px solid #e3e3e3; border-radius: 4px }}
svg text {{ font: 11px system-ui, sans-serif; fill: #444 }} svg .title {{ font-size: 14px; font-weight: 600; fill: #1a1a1a }}
svg .label {{ font-weight: 600; fill: #1a1a1a }} svg .grid {{ stroke: #ededed }}
svg .front {{ fill: none; stroke: #999; stroke-dasharray: 4 3 }} svg circle {{ opacity: .75 }}
svg .best {{ opacity: 1; stroke: #fff; stroke-width: 1.5 }}
.legend span {{ display: inline-block; margin-right: 1.1em }} .legend i {{ display: inline-block; width: .7em; height: .7em;
border-radius: 50%; margin-right: .35em }}
.wide {{ overflow-x: auto }} table {{ border-collapse: collapse; font-size: .85rem; width: 100% }}
th, td {{ padding: .28rem .55rem; text-align: right; white-space: nowrap; border-bottom: 1px solid #eee }}
td {{ font-variant-numeric: tabular-nums }}
th {{ vertical-align: bottom; white-space: normal; font-weight: 600 }} .sorts th {{ cursor: pointer }}
td:first-child, th:first-child {{ text-align: left; white-space: normal; min-width: 15em }}
td.best {{ background: #e8f4ec }} tr.default td:first-child {{ font-weight: 600 }} td small {{ color: #666; display: block }}
.pictures {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(490px, 1fr)); gap: 1.2rem 1rem }}
figure {{ margin: 0 }} figure div {{ display: flex; gap: 4px }} figcaption {{ font-size: .85rem }}
img {{ max-width: calc(50% - 2px); height: auto }}
</style></head><body>
)";

constexpr const char* kScript = R"(<script>
for (const table of document.querySelectorAll('table.sortable')) {
  table.classList.add('sorts');
  const body = table.tBodies[0];
  [...table.tHead.rows[0].cells].forEach((head, column) => head.addEventListener('click', () => {
    const down = head.dataset.down = head.dataset.down === '1' ? '0' : '1';
    const key = row => { const v = row.cells[column].dataset.v; return v === undefined ? row.cells[column].textContent : v === '' ? Infinity : +v; };
    const rows = [...body.rows].sort((a, b) => { const x = key(a), y = key(b); return (x < y ? -1 : x > y ? 1 : 0) * (down === '1' ? 1 : -1); });
    body.append(...rows);
  }));
}
</script>
)";

// One colour a knob, in the order of the rows.
std::vector<std::string> knobs_of(const Trade& trade) {
  std::vector<std::string> knobs;
  for (const Row& row : trade.rows)
    if (std::find(knobs.begin(), knobs.end(), row.configuration.knob) == knobs.end())
      knobs.push_back(row.configuration.knob);
  return knobs;
}

bool on_front(const Row& row, const std::string& front) {
  return std::find(row.fronts.begin(), row.fronts.end(), front) != row.fronts.end();
}

std::string plots_html(const Trade& trade, const std::vector<std::string>& knobs) {
  std::string html = "<div class=\"plots\">\n";
  for (const FrontKind& kind : front_kinds()) {
    Plot plot{kind.title, kind.cost_label, kind.error_label, {}};
    for (const Row& row : trade.rows) {
      const auto cost = kind.cost_of(row.measures), error = kind.error_of(row.measures);
      if (!cost || !error) continue;
      const auto knob = std::find(knobs.begin(), knobs.end(), row.configuration.knob) - knobs.begin();
      plot.dots.push_back({*cost, 100 * *error, row.configuration.name(),
                           fmt::format("{}\n{}: {:.3g}\n{}: {:.3g}", row.configuration.name(), kind.cost_label, *cost,
                                       kind.error_label, 100 * *error),
                           static_cast<int>(knob), on_front(row, kind.id)});
    }
    if (!plot.dots.empty()) html += plot_svg(plot);
  }
  html += "</div>\n<p class=\"legend quiet\">";
  for (std::size_t k = 0; k < knobs.size(); ++k)
    html += fmt::format("<span><i style=\"background:{}\"></i>{}</span>", plot_colours()[k % plot_colours().size()],
                        escaped(knobs[k]));
  return html + "</p>\n";
}

std::string row_html(const Row& row) {
  const Configuration& c = row.configuration;
  std::string options = options_text(c.bake) + (c.play.empty() ? "" : " | " + options_text(c.play));
  std::string html = fmt::format("<tr{}><td title=\"{}\">{}", c.knob == "default" ? " class=\"default\"" : "",
                                 escaped(options), escaped(c.name()));
  if (!row.failure.empty()) html += fmt::format("<small>failed: {}</small>", escaped(row.failure));
  html += "</td>";
  for (const Quantity& column : quantities()) {
    if (*column.title == 0) continue;
    const auto value = column.value(row.measures);
    if (!value) {
      html += "<td data-v=\"\"></td>";
      continue;
    }
    html += fmt::format("<td data-v=\"{:.9g}\"{}>{}</td>", *value, on_front(row, column.front) ? " class=\"best\"" : "",
                        fmt::format(fmt::runtime(column.format), column.scale * *value));
  }
  return html + "</tr>\n";
}

std::string table_html(const Trade& trade) {
  std::string html = "<div class=\"wide\"><table class=\"sortable\"><thead><tr><th>configuration</th>";
  for (const Quantity& column : quantities())
    if (*column.title != 0) html += fmt::format("<th>{}</th>", column.title);
  html += "</tr></thead><tbody>\n";
  for (const Row& row : trade.rows) html += row_html(row);
  return html + "</tbody></table></div>\n";
}

// The camera in whose frames reflections err most, where the default has any; else the first.
std::size_t telling_camera(const Trade& trade) {
  std::size_t telling = 0;
  double most = -1;
  if (trade.rows.empty()) return telling;
  const auto& frames = trade.rows[0].measures.frames;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (frames[i].specular.value_or(0) > most) most = frames[i].specular.value_or(0), telling = i;
  return telling;
}

// Configurations that differ in the light alone look alike: the reference once, then frame and FLIP of each.
std::string pictures_html(const Trade& trade) {
  const std::size_t camera = telling_camera(trade);
  std::string html;
  for (const Row& row : trade.rows) {
    if (camera >= row.pictures.size() || row.measures.frames.size() <= camera) continue;
    const auto pictures = thumbnails(row.pictures[camera], kWidestThumbnail);
    if (!pictures) continue;
    const auto image = [&](const std::string& uri, const std::string& what) {
      return fmt::format("<img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"{}\">\n", uri, pictures->width,
                         pictures->height, escaped(what));
    };
    if (html.empty())
      html = fmt::format("<figure><div>{}</div><figcaption>reference: {} paths a pixel</figcaption></figure>\n",
                         image(pictures->reference, "reference"), trade.plan.reference_paths);
    const std::string name = row.configuration.name();
    html += fmt::format("<figure><div>{}{}</div><figcaption>{}: FLIP {:.4f}</figcaption></figure>\n",
                        image(pictures->frame, name), image(pictures->flip, "FLIP of " + name), escaped(name),
                        row.measures.frames[camera].flip);
  }
  if (html.empty()) return {};
  return fmt::format(
      "<h2>Pictures</h2>\n<p class=\"quiet\">Camera {}. On the right FLIP, the difference that is seen: black "
      "none, white 1.</p>\n<div class=\"pictures\">\n{}</div>\n",
      escaped(trade.facts.cameras[camera]), html);
}

std::string conditions_html(const Trade& trade) {
  std::string cameras, renderer;
  for (const std::string& camera : trade.facts.cameras) cameras += (cameras.empty() ? "" : "; ") + camera;
  for (const Row& row : trade.rows)
    if (!row.measures.renderer.empty()) renderer = row.measures.renderer;
  std::string html = fmt::format(
      "<p class=\"quiet\">Measured on {} threads{}. Frames are timed at {} × {} pixels, and compared at {} × {} with "
      "{} paths a pixel. Cameras: {}.</p>\n",
      std::thread::hardware_concurrency(), renderer.empty() ? "" : ", frames by " + escaped(renderer), trade.width,
      trade.height, trade.plan.width, trade.plan.height, trade.plan.reference_paths, escaped(cameras));
  if (!trade.frames) html += "<p>Frames are left out: oriel-play is missing or cannot draw here.</p>\n";
  if (trade.left > 0)
    html += fmt::format("<p>Not finished: {} parts of the work are left. The same command goes on.</p>\n", trade.left);
  for (const std::string& skipped : trade.plan.skipped)
    html += fmt::format("<p class=\"quiet\">Not varied: {}.</p>\n", escaped(skipped));
  return html;
}

}  // namespace

std::string trade_html(const Trade& trade) {
  std::string html = fmt::format(fmt::runtime(kHead), escaped(trade.scene));
  html += fmt::format("<h1>{}: what accuracy costs</h1>\n", escaped(trade.scene));
  html +=
      "<p>Each dot is one way to bake or show this scene: the default, and the same with one knob changed. Lower is "
      "more "
      "accurate, further left is cheaper. Configurations on the dashed line are the best for what they cost: nothing "
      "measured here is both cheaper and better.</p>\n";
  html += conditions_html(trade) + plots_html(trade, knobs_of(trade));
  html +=
      "<h2>All configurations</h2>\n<p class=\"quiet\">Green: on the front of that cost (under texels relRMSE: of "
      "texels "
      "against bake time). Errors are net of the references' noise, which stands beside them; 0 means lost in it. D: "
      "what "
      "diffuse surfaces show, S: what reflectors do, over their pixels. A click on a heading sorts; pointing at a name "
      "shows its options.</p>\n";
  return html + table_html(trade) + pictures_html(trade) + kScript + "</body></html>\n";
}

}  // namespace oriel::trade
