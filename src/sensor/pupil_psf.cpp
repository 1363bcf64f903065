#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/error.h"
#include "math/fft.h"
#include "sensor/energy_table.h"
#include "sensor/mtf.h"
#include "sensor/psf.h"
#include "sensor/pupil.h"

namespace ifov::sensor {
namespace {

constexpr std::size_t kTransform = 2048, kPupilCells = 128;
/// Samples of the image per wavelength times f-number.
constexpr int kPerQ = static_cast<int>(kTransform / kPupilCells);
/// How far out samples are kept, in the same unit: as far as aliases are faint, or further where the energy lies there.
constexpr int kSampled = 24, kFarthestSampled = 48;
/// Between cells of the pupil the phase may turn by so much, in waves; more would be beyond kFarthestSampled.
constexpr double kSteepest = 0.375;

/// Intensities as shares of the whole energy on cells about the image's middle, rows of 2 reach + 1.
class PupilImage {
 public:
  explicit PupilImage(const Pupil& pupil) {
    check_pupil(pupil);
    const PupilCells cells = pupil_cells(pupil, kPupilCells, 2.0 / kPupilCells, true);
    check_steepness(cells);
    reach_ = kFarthestSampled * kPerQ;
    transform(cells);
  }

  int reach() const { return reach_; }
  double at(int i, int j) const {
    return share_[static_cast<std::size_t>((j + reach_) * side() + i + reach_)];
  }
  int side() const { return 2 * reach_ + 1; }
  /// Leaves nothing beyond so many cells.
  void crop(int reach) {
    std::vector<float> kept;
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i) kept.push_back(static_cast<float>(at(i, j)));
    share_ = std::move(kept);
    reach_ = reach;
  }

 private:
  static void check_steepness(const PupilCells& cells) {
    double most = 0.0;
    const auto compare = [&](std::size_t a, std::size_t b) {
      const std::complex<double> one = cells.amplitude[a], other = cells.amplitude[b];
      if (one != 0.0 && other != 0.0)
        most = std::max(most, std::abs(std::arg(one * std::conj(other))) / (2.0 * std::numbers::pi));
    };
    for (std::size_t j = 0; j < cells.across; ++j)
      for (std::size_t i = 0; i + 1 < cells.across; ++i) {
        compare(j * cells.across + i, j * cells.across + i + 1);
        compare(i * cells.across + j, (i + 1) * cells.across + j);
      }
    if (most > kSteepest)
      throw InputError(format(
          "the wavefront changes by {:.2g} wavelengths or more across {} of the pupil's diameter; expected {} at most",
          most, format("1/{}", kPupilCells), kSteepest));
  }

  void transform(const PupilCells& cells) {
    const math::Fft fft(kTransform);
    const auto sides = static_cast<std::size_t>(side());
    const auto place = [](int k) {
      return static_cast<std::size_t>(k < 0 ? k + static_cast<int>(kTransform) : k);
    };
    if (!(cells.open > 0.0)) throw InputError("nothing of the pupil is open");
    // Of the conjugate: a pixel looks the other way than light goes, so that its response is the image of a point turned by 180 deg.
    // Rows of the pupil, of which the columns of the image are kept; then these columns.
    std::vector<std::complex<double>> across(sides * kPupilCells), line(kTransform);
    for (std::size_t j = 0; j < kPupilCells; ++j) {
      std::fill(line.begin(), line.end(), std::complex<double>{});
      std::transform(&cells.amplitude[j * kPupilCells], &cells.amplitude[j * kPupilCells] + kPupilCells,
                     line.begin(), [](const std::complex<double>& a) { return std::conj(a); });
      fft.transform(line);
      for (int i = -reach_; i <= reach_; ++i)
        across[static_cast<std::size_t>(i + reach_) * kPupilCells + j] = line[place(i)];
    }
    share_.resize(sides * sides);
    // What is sampled are means over cells of the pupil: their image is that of a cell times the pupil's.
    const auto cell = [](int k) {
      return std::pow(square_mtf(1.0, static_cast<double>(k) / kTransform), -2.0);
    };
    std::vector<double> sharper;
    for (int k = -reach_; k <= reach_; ++k) sharper.push_back(cell(k));
    const double scale =
        1.0 / (cells.open * static_cast<double>(kTransform) * static_cast<double>(kTransform));
    for (std::size_t i = 0; i < sides; ++i) {
      std::fill(line.begin(), line.end(), std::complex<double>{});
      std::copy_n(&across[i * kPupilCells], kPupilCells, line.begin());
      fft.transform(line);
      for (int j = -reach_; j <= reach_; ++j)
        share_[static_cast<std::size_t>(j + reach_) * sides + i] = static_cast<float>(
            scale * sharper[i] * sharper[static_cast<std::size_t>(j + reach_)] * std::norm(line[place(j)]));
    }
  }

  int reach_ = 0;
  std::vector<float> share_;
};

/// Energy by distance from the middle, in rings a cell wide.
std::vector<double> ring_energies(const PupilImage& image) {
  std::vector<double> rings(static_cast<std::size_t>(image.reach()) + 1, 0.0);
  for (int j = -image.reach(); j <= image.reach(); ++j)
    for (int i = -image.reach(); i <= image.reach(); ++i) {
      const double r = std::hypot(i, j);
      if (r <= image.reach()) rings[static_cast<std::size_t>(r)] += image.at(i, j);
    }
  return rings;
}

class PupilPsf final : public Psf {
 public:
  PupilPsf(const Pupil& pupil, double encircled)
      : pupil_(pupil), cell_px_(pupil.q_px() / kPerQ), image_(pupil), table_(cut(encircled)) {}

  double half_width_px() const override { return table_.half_width_px(); }
  double detail_px() const override { return 0.5 * pupil_.q_px(); }
  double energy(double x0_px, double y0_px, double x1_px, double y1_px) const override {
    return table_.within(x0_px, y0_px, x1_px, y1_px);
  }
  double kept() const override { return kept_; }
  bool has_wings() const override { return true; }
  bool round() const override { return false; }
  double cut_density(double dx_px, double dy_px, bool smooth) const override {
    const double r = std::hypot(dx_px, dy_px) / cell_px_;
    if (r <= radius_) return 0.0;
    const double per_px2 = 1.0 / (cell_px_ * cell_px_);
    if (r >= image_.reach()) return per_px2 * far_ / (r * r * r);
    if (!smooth)
      return per_px2 * image_.at(static_cast<int>(std::lround(dx_px / cell_px_)),
                                 static_cast<int>(std::lround(dy_px / cell_px_)));
    const double at = std::clamp(r / kPerQ - 0.5, 0.0, static_cast<double>(cubed_.size()) - 1.0);
    const auto low = std::min(static_cast<std::size_t>(at), cubed_.size() - 2);
    return per_px2 * std::lerp(cubed_[low], cubed_[low + 1], at - static_cast<double>(low)) / (r * r * r);
  }
  std::string description() const override {
    return format(
        "diffraction of a pupil, wavelength times f-number {:.4g} px, Strehl ratio {:.3g}, traced to {:.4g} px; the {:.2g} % of the "
        "energy beyond are wings",
        pupil_.q_px(), strehl_ratio(pupil_), half_width_px(), 100.0 * (1.0 - kept_));
  }

 private:
  /// The image within the radius of the encircled energy; beyond it what wings need.
  EnergyTable cut(double encircled) {
    const std::vector<double> rings = ring_energies(image_);
    double sum = 0.0;
    std::size_t ring = 0;
    while (ring + 1 < rings.size() && sum + rings[ring] < encircled) sum += rings[ring++];
    if (ring + 1 >= rings.size())
      throw InputError(format(
          "the PSF of the pupil has only {:.3g} % of its energy within {} wavelengths times the f-number; expected {:g} % at least",
          100.0 * sum, kFarthestSampled, 100.0 * encircled));
    radius_ = static_cast<double>(ring) + (encircled - sum) / rings[ring];
    const int half = static_cast<int>(radius_);
    std::vector<double> within;
    kept_ = 0.0;
    for (int j = -half; j <= half; ++j)
      for (int i = -half; i <= half; ++i) {
        within.push_back(std::hypot(i, j) <= radius_ ? sharpened(i, j) : 0.0);
        kept_ += within.back();
      }
    const int reach = std::clamp(2 * half, kSampled * kPerQ, kFarthestSampled * kPerQ);
    tell_wings(rings, reach);
    image_.crop(reach);
    return {2 * half + 1, 2 * half + 1, cell_px_, within};
  }

  /// A table that is even over its cells widens what it is of by a twelfth of a cell's square: less of the second differences makes it as wide.
  double sharpened(int i, int j) const {
    const double here = image_.at(i, j), around = image_.at(i - 1, j) + image_.at(i + 1, j) +
                                                  image_.at(i, j - 1) + image_.at(i, j + 1);
    return std::max(0.0, here - (around - 4.0 * here) / 24.0);
  }

  /// Means over rings as wide as those of the pattern, times the cube of their distance; beyond the samples the rest, falling as that
  /// cube does.
  void tell_wings(const std::vector<double>& rings, int reach) {
    double sum = 0.0;
    for (int k = 0; k < reach; ++k) sum += rings[static_cast<std::size_t>(k)];
    far_ = std::max(0.0, 1.0 - sum) * reach / (2.0 * std::numbers::pi);
    for (int ring = 0; (ring + 1) * kPerQ <= reach; ++ring) {
      double energy = 0.0, weight = 0.0;  // of a density 1 / r^3
      for (int k = ring * kPerQ; k < (ring + 1) * kPerQ; ++k) {
        energy += rings[static_cast<std::size_t>(k)];
        weight += 2.0 * std::numbers::pi / ((k + 0.5) * (k + 0.5));
      }
      cubed_.push_back(energy / weight);
    }
  }

  Pupil pupil_;
  double cell_px_, radius_ = 0.0, kept_ = 0.0, far_ = 0.0;  // lengths in cells
  std::vector<double> cubed_;
  PupilImage image_;
  EnergyTable table_;
};

}  // namespace

std::unique_ptr<Psf> make_pupil_psf(const Pupil& pupil, double encircled_energy) {
  if (!(encircled_energy >= 0.5) || !(encircled_energy <= 0.995))
    throw InputError(
        format("a pupil's PSF cut at {} of its energy; expected 0.5 to 0.995", encircled_energy));
  return std::make_unique<PupilPsf>(pupil, encircled_energy);
}

}  // namespace ifov::sensor
