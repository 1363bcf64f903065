#include "materials/bsdf/node_bsdf.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.h"
#include "materials/bsdf/hemisphere.h"

namespace ifov::materials {
namespace {

constexpr std::size_t kAngles = 33;
constexpr double kLeastCosine = 1e-3;  // of the last angle, where nothing is seen from

double cosine_of(std::size_t angle) {
  return std::max(kLeastCosine, static_cast<double>(angle) / static_cast<double>(kAngles - 1));
}

}  // namespace

NodeBsdf::NodeBsdf(std::shared_ptr<const Bsdf> bsdf, const radiometry::SpectralNodes& nodes, bool polarized)
    : bsdf_(std::move(bsdf)),
      parameters_(std::max<std::size_t>(
                      1, bsdf_->spectra().size() + (polarized ? bsdf_->polarization_spectra().size() : 0)),
                  nodes.node_count()),
      emissivity_(kAngles, nodes.node_count()) {
  for (std::size_t k = 0; k < bsdf_->spectra().size(); ++k) {
    nodes.average_surface(bsdf_->spectra()[k], parameters_.values(k));
    pointers_.push_back(parameters_.row(k));
  }
  if (bsdf_->absorption() != nullptr) {
    has_absorption_ = true;
    absorption_.resize(1, nodes.node_count());
    nodes.average_surface(*bsdf_->absorption(), absorption_.values(0));
  }
  polarized_ = polarized && bsdf_->polarizes();
  const bool q_wanted = polarized_ && !bsdf_->is_delta();
  if (q_wanted) emitted_q_.resize(kAngles, nodes.node_count());
  if (polarized_) {
    for (const radiometry::Spectrum& spectrum : bsdf_->polarization_spectra()) {
      nodes.average_surface(spectrum, parameters_.values(pointers_.size()));
      pointers_.push_back(parameters_.row(pointers_.size()));
    }
  }
  radiometry::SpectrumBlock reflected(kAngles, nodes.node_count()), transmitted(kAngles, nodes.node_count());
  parallel_for(kAngles, 0, [&](std::int64_t index) {
    const auto k = static_cast<std::size_t>(index);
    const double cosine = cosine_of(k);
    if (q_wanted)
      polarized_hemispherical(*bsdf_, Side::reflected, pointers_, nodes.node_count(), cosine,
                              reflected.row(k), emitted_q_.row(k));
    else
      directional_hemispherical(*bsdf_, Side::reflected, pointers_, nodes.node_count(), cosine,
                                reflected.row(k));
    if (bsdf_->may_transmit() && q_wanted) {
      std::vector<float> q(nodes.node_count());
      polarized_hemispherical(*bsdf_, Side::transmitted, pointers_, nodes.node_count(), cosine,
                              transmitted.row(k), q.data());
      for (std::size_t n = 0; n < q.size(); ++n) emitted_q_.row(k)[n] += q[n];
    } else if (bsdf_->may_transmit()) {
      directional_hemispherical(*bsdf_, Side::transmitted, pointers_, nodes.node_count(), cosine,
                                transmitted.row(k));
    }
    if (q_wanted)
      for (std::size_t n = 0; n < nodes.node_count(); ++n) emitted_q_.row(k)[n] *= -1.0f;
    for (std::size_t n = 0; n < nodes.node_count(); ++n)
      emissivity_.row(k)[n] = std::max(0.0f, 1.0f - reflected.row(k)[n] - transmitted.row(k)[n]);
  });
  for (std::size_t k = 0; k < kAngles; ++k)
    for (std::size_t n = 0; n < nodes.node_count(); ++n) {
      highest_[0] = std::max(highest_[0], static_cast<double>(reflected.row(k)[n]));
      highest_[1] = std::max(highest_[1], static_cast<double>(transmitted.row(k)[n]));
    }
}

double NodeBsdf::highest_share(const BsdfEvent& view, Side side) const {
  if (side == Side::transmitted && !bsdf_->may_transmit()) return 0.0;
  BsdfEvent event = view;
  event.side = side;
  const BsdfSample only = bsdf_->sample(event, 0.5, 0.5);
  if (!(only.weight > 0.0)) return 0.0;
  event.incoming = only.incoming;
  thread_local std::vector<float> shares;
  shares.resize(parameters_.stride());
  evaluate(event, shares.data());
  float highest = 0.0f;
  for (std::size_t n = 0; n < parameters_.columns(); ++n) highest = std::max(highest, shares[n]);
  return static_cast<double>(highest);
}

void NodeBsdf::emissivity(double cosine, float* spectrum, float* work) const {
  if (bsdf_->is_delta()) {
    BsdfEvent event;
    event.outgoing = {std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), 0.0, cosine};
    event.normal = {0.0, 0.0, 1.0};
    event.incoming = bsdf_->sample(event, 0.5, 0.5).incoming;
    evaluate(event, work);
    for (std::size_t n = 0; n < emissivity_.stride(); ++n) spectrum[n] = 1.0f - work[n];
    event.side = Side::transmitted;
    if (bsdf_->may_transmit()) {
      const BsdfSample through = bsdf_->sample(event, 0.5, 0.5);
      event.incoming = through.incoming;
      evaluate(event, work);
      if (through.weight > 0.0)
        for (std::size_t n = 0; n < emissivity_.stride(); ++n) spectrum[n] -= work[n];
    }
    for (std::size_t n = 0; n < emissivity_.stride(); ++n) spectrum[n] = std::max(0.0f, spectrum[n]);
    return;
  }
  between_angles(emissivity_, cosine, spectrum);
}

bool NodeBsdf::polarized_emission(double cosine, float* spectrum) const {
  if (polarized_ && bsdf_->is_delta() && !bsdf_->is_separable()) {
    const std::size_t n = emissivity_.stride();
    thread_local std::vector<float> column;
    column.resize(4 * n);
    const MuellerRows rows{column.data(), n, false};
    BsdfEvent event;
    event.outgoing = {std::sqrt(std::max(0.0, 1.0 - cosine * cosine)), 0.0, cosine};
    event.normal = {0.0, 0.0, 1.0};
    std::fill_n(spectrum, n, 0.0f);
    for (const Side side : {Side::reflected, Side::transmitted}) {
      if (side == Side::transmitted && !bsdf_->may_transmit()) continue;
      event.side = side;
      const BsdfSample only = bsdf_->sample(event, 0.5, 0.5);
      if (!(only.weight > 0.0)) continue;
      event.incoming = only.incoming;
      evaluate_mueller(event, rows);
      for (std::size_t k = 0; k < n; ++k) spectrum[k] -= rows.at(1, 0)[k];
    }
    return true;
  }
  if (emitted_q_.rows() == 0) return false;
  between_angles(emitted_q_, cosine, spectrum);
  return true;
}

void NodeBsdf::between_angles(const radiometry::SpectrumBlock& rows, double cosine, float* spectrum) const {
  const double position = std::clamp(cosine, 0.0, 1.0) * static_cast<double>(kAngles - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kAngles - 2);
  const float share = static_cast<float>(position - static_cast<double>(below));
  const float* __restrict a = rows.row(below);
  const float* __restrict b = rows.row(below + 1);
  for (std::size_t n = 0; n < rows.stride(); ++n) spectrum[n] = a[n] + share * (b[n] - a[n]);
}

}  // namespace ifov::materials
