#include "forest/train/training_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "forest/train/report_picture.h"
#include "libtracker/core/atomic_file.h"

namespace depthmocap {
namespace {

std::string forestTable(const Forest& forest, std::uintmax_t bytes) {
  std::string text = "| tree | nodes | leaves | depth |\n|---|---|---|---|\n";
  for (std::size_t t = 0; t < forest.trees.size(); ++t) {
    const ForestTree& tree = forest.trees[t];
    text +=
        fmt::format("| {} | {} | {} | {} |\n", t + 1, tree.nodes.size(), tree.nodes.size() / 2 + 1, treeDepth(tree));
  }
  return text + fmt::format("\nFile: {:.2f} MB.\n", static_cast<double>(bytes) / 1e6);
}

// The part that pixels of `part` are taken for most often when they are not recognised.
std::size_t mostConfused(const ConfusionMatrix& confusion, std::size_t part) {
  std::size_t worst = part == 0 ? 1 : 0;
  for (std::size_t other = 0; other < kPartCount; ++other) {
    if (other != part && confusion.count[part][other] > confusion.count[part][worst]) worst = other;
  }
  return worst;
}

std::string accuracyTable(const ConfusionMatrix& confusion) {
  std::string text = "| part | right | most often taken for |\n|---|---|---|\n";
  for (std::size_t part = 0; part < kPartCount; ++part) {
    const auto& row = confusion.count[part];
    std::uint64_t all = 0;
    for (const auto n : row) all += n;
    if (all == 0) continue;
    const std::size_t worst = mostConfused(confusion, part);
    text += fmt::format("| {} | {:.1f} % | {} ({:.1f} %) |\n", kPartNames[part + 1],
                        100 * confusion.accuracyOf(static_cast<int>(part)), kPartNames[worst + 1],
                        100 * static_cast<double>(row[worst]) / static_cast<double>(all));
  }
  return text;
}

std::string curveTable(const std::string& what, const std::vector<CurvePoint>& curve) {
  if (curve.empty()) return {};
  std::string head = "| " + what, rule = "|---", row = "| mean accuracy";
  for (const CurvePoint& point : curve) {
    head += fmt::format(" | {}", point.x);
    rule += "|---";
    row += fmt::format(" | {:.1f} %", 100 * point.mean_accuracy);
  }
  return head + " |\n" + rule + "|\n" + row + " |\n\n";
}

}  // namespace

std::array<std::filesystem::path, 2> trainingReportFiles(const std::filesystem::path& stem) {
  std::filesystem::path text = stem;
  std::filesystem::path picture = stem;
  return {text += ".report.md", picture += ".report.png"};
}

void writeTrainingReport(const TrainingReport& report, const Forest& forest, std::uintmax_t forest_bytes,
                         const std::filesystem::path& stem) {
  const auto [text_path, picture] = trainingReportFiles(stem);
  const ConfusionMatrix& confusion = report.accuracy.all;
  std::string text = fmt::format("# {}\n\nMade by\n\n```\n{}\n```\n\n", report.title, report.command);
  text += fmt::format("Trained on {}. Measured on {}.\n\n", report.data, report.validation);
  text += fmt::format("Time: {:.0f} s rendering, {:.0f} s training.\n\n", report.render_s, report.training_s);
  text += forestTable(forest, forest_bytes) + "\n## Accuracy on held-out images\n\n";
  text += fmt::format("Mean over the parts **{:.1f} %**; over all pixels {:.1f} % of {}.\n\n",
                      100 * confusion.meanAccuracy(), 100 * confusion.accuracy(), confusion.total());
  if (forest.facings > 1) {
    text += fmt::format(
        "Seen from the front {:.1f} %. The side that is seen was found in {:.1f} % of the images; had it been "
        "told, the mean over the parts were {:.1f} %.\n\n",
        100 * report.accuracy.from[static_cast<std::size_t>(Facing::Front)].meanAccuracy(),
        100 * report.accuracy.facingAccuracy(), 100 * report.accuracy.given_facing.meanAccuracy());
  }
  text += accuracyTable(confusion) + "\n## Learning curves\n\n";
  text += curveTable("trees", report.by_trees) + curveTable("depth", report.by_depth) +
          curveTable("images (one tree)", report.by_images);
  text += fmt::format("![Confusion matrix and learning curves]({})\n", picture.filename().string());
  drawReport(report, picture);
  writeFileAtomically(text_path, text);
}

}  // namespace depthmocap
