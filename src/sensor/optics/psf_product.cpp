#include "sensor/optics/psf_product.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>

#include "core/error.h"
#include "math/fft.h"
#include "sensor/energy_table.h"
#include "sensor/mtf.h"
#include "sensor/optics/carrier_diffusion.h"
#include "sensor/psf.h"

namespace ifov::sensor {
namespace {

constexpr double kCellsOverDetail = 8.0, kCoarsestCell_px = 1.0 / 16.0, kSharpest_px = 1.0 / 32.0;
constexpr std::size_t kFewestCells = 64, kMostCells = 1024;
/// Of a Gaussian: where it is cut, and beyond which nothing of it matters.
constexpr double kCutSigmas = 4.4, kFarSigmas = 8.0;

double sigma_of(const PsfParts& parts) {
  double sum = 0.0;
  for (const double sigma : parts.sigmas_px) sum += sigma * sigma;
  return std::sqrt(sum);
}

double widest_image_px(const PsfParts& parts) {
  double sum = 0.0;
  for (const auto& image : parts.images) sum += image->half_width_px();
  return sum;
}

/// What is left of the finest structures: no less than the coarsest of the parts.
double detail_of(const PsfParts& parts) {
  double detail = kSharpest_px;
  detail = std::max(detail, sigma_of(parts));
  if (parts.diffracted) detail = std::max(detail, parts.diffracted->detail_px());
  for (const auto& image : parts.images) detail = std::max(detail, image->detail_px());
  for (const CarrierDiffusion& one : parts.diffusion)
    detail = std::max(detail, 0.5 * one.field_free_px);  // of light from the front some carriers stay
  return detail;
}

/// Energies on n x n cells about 0, the first of which is that in the middle; negative places follow the positive ones, from the far end.
class Cells {
 public:
  Cells(std::size_t count, double side_px) : n_(count), side_px_(side_px), values_(count * count) {}

  std::size_t count() const { return n_; }
  double side_px() const { return side_px_; }
  /// As far as cells are the same both ways.
  int reach() const { return static_cast<int>(n_ / 2) - 1; }
  std::complex<double>& at(int i, int j) { return values_[place(j) * n_ + place(i)]; }
  double energy(int i, int j) const { return std::max(0.0, values_[place(j) * n_ + place(i)].real()); }

  template <class Each>
  void for_each(const Each& each) {
    for (std::size_t j = 0; j < n_; ++j)
      for (std::size_t i = 0; i < n_; ++i) each(number(i), number(j), values_[j * n_ + i]);
  }

  /// Of PSFs that are known as energies.
  void fill(const Psf& psf) {
    const bool rings_are_fine = psf.detail_px() < 2.0 * side_px_, mirrored = psf.mirrored() && !is_image(psf);
    const int most = reach();
    for (int j = mirrored ? 0 : -most; j <= most; ++j)
      for (int i = mirrored ? 0 : -most; i <= most; ++i) {
        const double x = i * side_px_, y = j * side_px_, half = 0.5 * side_px_;
        const double energy = psf.kept() * psf.energy(x - half, y - half, x + half, y + half) +
                              side_px_ * side_px_ * psf.cut_density(x, y, rings_are_fine);
        at(i, j) = energy;
        if (mirrored) at(-i, j) = at(i, -j) = at(-i, -j) = energy;
      }
  }

  void transform() {
    const math::Fft fft(n_);
    std::vector<std::complex<double>> line(n_);
    for (std::size_t j = 0; j < n_; ++j) fft.transform(std::span(values_).subspan(j * n_, n_));
    for (std::size_t i = 0; i < n_; ++i) {
      for (std::size_t j = 0; j < n_; ++j) line[j] = values_[j * n_ + i];
      fft.transform(line);
      for (std::size_t j = 0; j < n_; ++j) values_[j * n_ + i] = line[j];
    }
  }
  void transform_back() {
    for (std::complex<double>& value : values_) value = std::conj(value);
    transform();
    const double scale = 1.0 / static_cast<double>(values_.size());
    for (std::complex<double>& value : values_) value = std::conj(value) * scale;
  }

 private:
  static bool is_image(const Psf& psf) { return !psf.has_wings(); }
  std::size_t place(int k) const { return static_cast<std::size_t>(k < 0 ? k + static_cast<int>(n_) : k); }
  int number(std::size_t k) const {
    return k < n_ / 2 ? static_cast<int>(k) : static_cast<int>(k) - static_cast<int>(n_);
  }

  std::size_t n_;
  double side_px_;
  std::vector<std::complex<double>> values_;
};

class ProductPsf final : public Psf {
 public:
  ProductPsf(const PsfParts& parts, double left_out)
      : diffracted_(parts.diffracted.get()),
        detail_px_(detail_of(parts)),
        images_(!parts.images.empty()),
        table_(tabulate(parts, left_out)) {
    round_ = !images_ && (diffracted_ == nullptr || diffracted_->round());
    mirrored_ = !images_ && (diffracted_ == nullptr || diffracted_->mirrored());
    has_wings_ = diffracted_ != nullptr;
    describe(parts);
  }

  double half_width_px() const override { return table_.half_width_px(); }
  double detail_px() const override { return detail_px_; }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return table_.within(x0_px, y0_px, x1_px, y1_px);
  }
  double kept() const override { return kept_; }
  bool has_wings() const override { return has_wings_; }
  bool round() const override { return round_; }
  bool mirrored() const override { return mirrored_; }
  std::string description() const override { return description_; }

  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    const double r = std::hypot(dx_px, dy_px);
    if (r <= cut_px_) return 0.0;
    if (std::max(std::abs(dx_px), std::abs(dy_px)) < (reach_ - 1) * side_px_)
      return smooth && has_wings_ ? of_rings(r) : between_cells(dx_px, dy_px);
    // So far out what others spread of a density that falls as 1 / r^3 is half their variance times its second derivatives.
    return has_wings_ ? diffracted_->cut_density(dx_px, dy_px, smooth) * (1.0 + 4.5 * variance_px2_ / (r * r))
                      : 0.0;
  }

  void keep(std::unique_ptr<const Psf> diffracted) { owned_ = std::move(diffracted); }

 private:
  EnergyTable tabulate(const PsfParts& parts, double left_out) {
    const double sigma = sigma_of(parts), images = widest_image_px(parts);
    double diffused = 0.0, diffused_cut = 0.0;
    for (const CarrierDiffusion& one : parts.diffusion) {
      constexpr double kOfReach = 0.7;
      diffused += one.reach_px(), diffused_cut += kOfReach * one.reach_px();
      variance_px2_ += one.variance_px2();
    }
    variance_px2_ += sigma * sigma;
    const double others = kFarSigmas * sigma + diffused + images;
    double reach = others;
    if (diffracted_ != nullptr) {
      cut_px_ =
          std::hypot(diffracted_->half_width_px(), std::hypot(kCutSigmas * sigma, diffused_cut) + images);
      reach = std::max(2.0 * cut_px_, diffracted_->half_width_px() + others);
    }
    const double wanted = std::min(kCoarsestCell_px, detail_px_ / kCellsOverDetail);
    const std::size_t count =
        std::clamp(std::bit_ceil(static_cast<std::size_t>(std::min(2.0 * reach / wanted, 1e9)) + 4),
                   kFewestCells, kMostCells);
    side_px_ = std::max(wanted, 2.0 * reach / (static_cast<double>(count) - 4.0));
    Cells cells(count, side_px_);
    convolve(parts, cells);
    reach_ = cells.reach();
    if (diffracted_ == nullptr) cut_px_ = radius_that_leaves(cells, left_out);
    cut_px_ = std::min(cut_px_, reach_ * side_px_);
    return cut(cells);
  }

  void convolve(const PsfParts& parts, Cells& cells) {
    const auto smooth = [&](double cycles_px) {
      double product = 1.0;
      for (const double sigma : parts.sigmas_px) product *= gaussian_mtf(sigma, cycles_px);
      for (const CarrierDiffusion& one : parts.diffusion) product *= one.mtf(cycles_px);
      return product;
    };
    const double step = 1.0 / (static_cast<double>(cells.count()) * side_px_);
    const auto cell = [&](int i, int j) {
      return square_mtf(side_px_, i * step) * square_mtf(side_px_, j * step);
    };
    std::vector<const Psf*> known;
    if (diffracted_ != nullptr) known.push_back(diffracted_);
    for (const auto& image : parts.images) known.push_back(image.get());
    // Of a point that stays one a cell is all; what is smooth is known by its modulation.
    constexpr double kNone = 1e-3;
    const bool diffraction_ends = diffracted_ != nullptr && diffracted_->detail_px() >= side_px_;
    const bool sharp = !diffraction_ends && smooth(0.5 / side_px_) > kNone;
    if (known.empty()) {
      cells.for_each([&](int i, int j, auto& value) { value = sharp ? 1.0 : cell(i, j); });
    } else {
      cells.fill(*known.front());
      cells.transform();
    }
    // Energies of cells that are then even over them are wider than what they are of, by a sixth of a cell's square.
    if (!sharp)
      cells.for_each([&](int i, int j, auto& value) {
        const double x = i * step * side_px_, y = j * step * side_px_;
        value *= 1.0 + std::numbers::pi * std::numbers::pi / 3.0 * (x * x + y * y);
      });
    for (std::size_t k = 1; k < known.size(); ++k) {
      Cells more(cells.count(), side_px_);
      more.fill(*known[k]);
      more.transform();
      cells.for_each([&](int i, int j, auto& value) { value *= more.at(i, j) / cell(i, j); });
    }
    if (!parts.sigmas_px.empty() || !parts.diffusion.empty()) {
      // It goes by the distance: alike in all eighths.
      const auto rows = cells.count() / 2 + 1;
      std::vector<double> eighth;
      for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i <= j; ++i)
          eighth.push_back(smooth(step * std::hypot(static_cast<double>(i), static_cast<double>(j))));
      cells.for_each([&](int i, int j, auto& value) {
        const auto low = static_cast<std::size_t>(std::min(std::abs(i), std::abs(j))),
                   high = static_cast<std::size_t>(std::max(std::abs(i), std::abs(j)));
        value *= eighth[high * (high + 1) / 2 + low];
      });
    }
    cells.transform_back();
  }

  static double radius_that_leaves(const Cells& cells, double left_out) {
    std::vector<double> rings(2 * cells.count(), 0.0);
    for (int j = -cells.reach(); j <= cells.reach(); ++j)
      for (int i = -cells.reach(); i <= cells.reach(); ++i)
        rings[static_cast<std::size_t>(std::ceil(std::hypot(i, j)))] += cells.energy(i, j);
    double beyond = 0.0;
    std::size_t ring = rings.size();
    while (ring > 1 && beyond + rings[ring - 1] <= left_out) beyond += rings[--ring];
    return static_cast<double>(ring) * cells.side_px();
  }

  EnergyTable cut(const Cells& cells) {
    const double radius = cut_px_ / side_px_;
    const int half = std::min(reach_, static_cast<int>(std::ceil(radius)));
    std::vector<double> within;
    kept_ = 0.0;
    for (int j = -half; j <= half; ++j)
      for (int i = -half; i <= half; ++i) {
        within.push_back(std::hypot(i, j) <= radius ? cells.energy(i, j) : 0.0);
        kept_ += within.back();
      }
    kept_ = std::min(1.0, kept_);
    for (int j = -reach_; j <= reach_; ++j)
      for (int i = -reach_; i <= reach_; ++i) beyond_.push_back(static_cast<float>(cells.energy(i, j)));
    tell_rings();
    return {2 * half + 1, 2 * half + 1, side_px_, within};
  }

  double cell_energy(int i, int j) const {
    return static_cast<double>(
        beyond_[static_cast<std::size_t>((j + reach_) * (2 * reach_ + 1) + i + reach_)]);
  }

  double between_cells(double dx_px, double dy_px) const {
    const double x = dx_px / side_px_, y = dy_px / side_px_;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double u = x - i, v = y - j;
    const double sum = (1.0 - v) * ((1.0 - u) * cell_energy(i, j) + u * cell_energy(i + 1, j)) +
                       v * ((1.0 - u) * cell_energy(i, j + 1) + u * cell_energy(i + 1, j + 1));
    return sum / (side_px_ * side_px_);
  }

  /// Means over rings as wide as those of the pattern, times the cube of their distance.
  void tell_rings() {
    if (diffracted_ == nullptr) return;
    ring_px_ = std::max(2.0 * side_px_, 2.0 * diffracted_->detail_px());
    const auto count = static_cast<std::size_t>(std::max(2.0, reach_ * side_px_ / ring_px_));
    std::vector<double> energy(count, 0.0), weight(count, 0.0);
    for (int j = -reach_; j <= reach_; ++j)
      for (int i = -reach_; i <= reach_; ++i) {
        const double r = side_px_ * std::hypot(i, j);
        const auto ring = static_cast<std::size_t>(r / ring_px_);
        if (ring >= count || r == 0.0) continue;
        energy[ring] += cell_energy(i, j), weight[ring] += side_px_ * side_px_ / (r * r * r);
      }
    for (std::size_t k = 0; k < count; ++k) cubed_.push_back(weight[k] > 0.0 ? energy[k] / weight[k] : 0.0);
  }

  double of_rings(double r_px) const {
    const double at = std::clamp(r_px / ring_px_ - 0.5, 0.0, static_cast<double>(cubed_.size()) - 1.0);
    const auto low = std::min(static_cast<std::size_t>(at), cubed_.size() - 2);
    return std::lerp(cubed_[low], cubed_[low + 1], at - static_cast<double>(low)) / (r_px * r_px * r_px);
  }

  void describe(const PsfParts& parts) {
    std::string of;
    const auto add = [&](const std::string& part) { of += (of.empty() ? "" : ", ") + part; };
    if (diffracted_ != nullptr) add("diffraction");
    for (std::size_t k = 0; k < parts.images.size(); ++k) add("a kernel");
    for (const double sigma : parts.sigmas_px) add(format("a Gaussian of sigma {:g} px", sigma));
    for (const CarrierDiffusion& one : parts.diffusion)
      add(format("carrier diffusion by {:.3g} px along an axis", std::sqrt(one.variance_px2())));
    description_ = format("{}, convolved, traced to {:.4g} px, ", of, half_width_px()) +
                   (has_wings_ ? format("the {:.2g} % of the energy beyond are wings", 100.0 * (1.0 - kept_))
                               : format("which leaves out {:.2g} % of the energy", 100.0 * (1.0 - kept_)));
  }

  const Psf* diffracted_;
  std::unique_ptr<const Psf> owned_;
  double detail_px_, cut_px_ = 0.0, side_px_ = 0.0, kept_ = 1.0, variance_px2_ = 0.0, ring_px_ = 0.0;
  int reach_ = 0;
  bool images_, round_ = false, mirrored_ = false, has_wings_ = false;
  std::vector<float> beyond_;  // by cell
  std::vector<double> cubed_;
  std::string description_;
  EnergyTable table_;
};

}  // namespace

PsfParts::PsfParts() = default;
PsfParts::PsfParts(PsfParts&&) noexcept = default;
PsfParts::~PsfParts() = default;

std::unique_ptr<Psf> make_product_psf(PsfParts parts, double left_out) {
  if (!parts.diffracted && parts.images.empty() && parts.sigmas_px.empty() && parts.diffusion.empty())
    throw InputError("a PSF of no parts");
  auto made = std::make_unique<ProductPsf>(parts, left_out);
  made->keep(std::move(parts.diffracted));
  return made;
}

}  // namespace ifov::sensor
