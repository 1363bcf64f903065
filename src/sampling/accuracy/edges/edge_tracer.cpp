#include "sampling/accuracy/edges/edge_tracer.h"

namespace ifov::sampling {

namespace {

/// Passes of tracing in which borders are made sharper.
constexpr int kMaxPasses = 24;

}  // namespace

EdgeTracer::EdgeTracer(const Lattice& lattice, RayLedger& ledger, LabelTable& table, Contrast& contrast,
                       const AccuracyOptions& options, const AccuracyFaults& faults, std::uint64_t seed)
    : lattice_(lattice),
      ledger_(ledger),
      table_(table),
      contrast_(contrast),
      options_(options),
      faults_(faults),
      seed_(seed),
      allowed_variance_(static_cast<std::size_t>(lattice.domain().count()), 1.0),
      budget_(allowed_variance_.size(), options.tracing_budget),
      abandoned_(allowed_variance_.size(), 0),
      suspect_(allowed_variance_.size(), 0),
      followed_(allowed_variance_.size(), 0),
      stirred_(allowed_variance_.size(), 1),
      changed_(allowed_variance_.size(), 1),
      due_(allowed_variance_.size(), 0),
      sharpened_for_(allowed_variance_.size(), 0.0),
      edge_lists_(allowed_variance_.size()) {}

void EdgeTracer::settle() {
  for (int pass = 0;; ++pass) {
    grow();
    // What there is then is verified to its end: that splits cells, but opens none that was verified.
    if (pass < kMaxPasses) sharpen();
    if (!new_cells_.empty()) continue;
    if (tentative_.empty() && open_junctions_.empty()) return;
    verify_junctions();
    verify();
  }
}

/// What the lattice did not announce may turn out while tracing: a pixel that has cost this much is clutter.
void EdgeTracer::give_up_clutter() {
  if (!options_.clutter_switch) return;
  const std::span<const std::uint32_t> rays = ledger_.label_rays();
  bool any = false;
  for (std::size_t p = 0; p < rays.size(); ++p) any |= rays[p] > budget_[p];  // many at a time
  if (!any) return;
  for (std::size_t p = 0; p < rays.size(); ++p)
    if (rays[p] > budget_[p]) {
      abandon(static_cast<std::uint32_t>(p));
      budget_[p] = ~std::uint32_t{0};  // once is enough
    }
}

void EdgeTracer::ask(std::vector<std::uint32_t>& labels, Purpose purpose) {
  first_seen_point_.resize(table_.size());
  ledger_.labels(points_, labels, purpose);
  if (table_.size() > valued_) {
    for (std::size_t i = 0; i < labels.size() && first_seen_point_.size() < table_.size(); ++i)
      if (labels[i] == first_seen_point_.size()) first_seen_point_.push_back(points_[i]);
    value_new_labels();
  }
  points_.clear();
}

/// One value of each label that has none yet, where it was seen first. The values may bring labels of their
/// own, whose turn comes with the next question.
void EdgeTracer::value_new_labels() {
  std::vector<PathRequest> requests;
  std::vector<std::uint32_t> wanted;
  for (auto l = static_cast<std::uint32_t>(valued_); l < table_.size(); ++l)
    if (table_.count(l) == 0 && table_.merged(l) == l) {
      requests.push_back({first_seen_point_[l], hash(seed_, table_.label(l), 0x6e6577), 0});
      wanted.push_back(l);
    }
  valued_ = table_.size();
  if (requests.empty()) return;
  std::vector<std::uint32_t> labels;
  const std::size_t stride = static_cast<std::size_t>(ledger_.field().stride());
  std::vector<float> values(requests.size() * stride);
  ledger_.first_values(requests, labels, values);
  for (std::size_t i = 0; i < wanted.size(); ++i) table_.add(wanted[i], &values[i * stride]);
  first_seen_point_.resize(table_.size(), requests.back().point);
}

}  // namespace ifov::sampling
