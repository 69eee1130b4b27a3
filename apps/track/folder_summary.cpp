#include "apps/track/folder_summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include <fmt/format.h>

#include "libtracker/clinical/movement_events.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/json_file.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// What the files of one recording say.
struct Results {
  int frames = 0;
  int tracked = 0;
  int lost = 0;
  double duration_s = 0;
  double stature_m = 0;
  std::array<int, kMovementNames.size()> movements{};
  bool any_angle = false;
  ClinicalAngles least = ClinicalAngles::Constant(1e9);
  ClinicalAngles greatest = ClinicalAngles::Constant(-1e9);
};

void addAngles(const std::vector<AnglesRow>& rows, Results& results) {
  for (const AnglesRow& row : rows) {
    if (row.state == TrackState::Lost) continue;
    results.any_angle = true;
    results.least = results.least.cwiseMin(row.angles);
    results.greatest = results.greatest.cwiseMax(row.angles);
  }
  if (!rows.empty()) results.duration_s = rows.back().time_s - rows.front().time_s;
  for (const MovementEvent& event : findMovements(rows)) ++results.movements[static_cast<std::size_t>(event.kind)];
}

std::optional<Results> resultsOf(const FolderEntry& entry) {
  const fs::path stats_file = entry.out / "stats.json";
  if (!fs::exists(stats_file)) return std::nullopt;
  const nlohmann::json stats = readJsonFile(stats_file);
  const std::string where = stats_file.string();
  Results results;
  results.frames = jsonInteger(stats, "frames", where);
  results.tracked = jsonInteger(stats, "tracked", where);
  results.lost = jsonInteger(stats, "lost", where);
  results.stature_m = jsonNumber(stats, "stature_m", where);
  addAngles(readAnglesFile(entry.out / "angles.csv"), results);
  return results;
}

std::string header() {
  std::string text = "recording,status,frames,tracked,lost,duration_s,stature_m";
  for (const std::string_view movement : kMovementNames) {
    std::string column(movement);
    std::ranges::replace(column, ' ', '_');
    text += fmt::format(",{}s", column);
  }
  for (const std::string_view angle : kClinicalAngleNames) text += fmt::format(",{0}_min,{0}_max", angle);
  return text + "\n";
}

std::string line(const FolderEntry& entry) {
  const auto results = resultsOf(entry);
  std::string text = fmt::format("{},{}", entry.name, entry.status);
  if (!results) return text + std::string(5 + kMovementNames.size() + 2 * kClinicalAngleCount, ',') + "\n";
  text += fmt::format(",{},{},{},{:.3f},{:.3f}", results->frames, results->tracked, results->lost, results->duration_s,
                      results->stature_m);
  for (const int count : results->movements) text += fmt::format(",{}", count);
  for (int a = 0; a < kClinicalAngleCount; ++a) {
    text += results->any_angle ? fmt::format(",{:.1f},{:.1f}", results->least[a], results->greatest[a]) : ",,";
  }
  return text + "\n";
}

}  // namespace

void writeFolderSummary(const fs::path& path, const std::vector<FolderEntry>& entries) {
  std::string text = header();
  for (const FolderEntry& entry : entries) text += line(entry);
  writeFileAtomically(path, text);
}

std::string folderTable(const std::vector<FolderEntry>& entries) {
  std::size_t width = std::string("recording").size();
  for (const FolderEntry& entry : entries) width = std::max(width, entry.name.size());
  std::string text = fmt::format("{:{}}  {:11}  {:>7}  {:>7}  {:>8}  {:>5}  {:>5}  {:>8}\n", "recording", width,
                                 "status", "frames", "tracked", "stature", "steps", "jumps", "stood up");
  for (const FolderEntry& entry : entries) {
    text += fmt::format("{:{}}  {:11}", entry.name, width, entry.status);
    if (const auto r = resultsOf(entry)) {
      const auto count = [&](MovementKind kind) { return r->movements[static_cast<std::size_t>(kind)]; };
      text += fmt::format("  {:7}  {:7}  {:6.2f} m  {:5}  {:5}  {:8}", r->frames, r->tracked, r->stature_m,
                          count(MovementKind::LeftStep) + count(MovementKind::RightStep), count(MovementKind::Jump),
                          count(MovementKind::SitToStand));
    }
    text += '\n';
  }
  return text;
}

}  // namespace depthmocap
