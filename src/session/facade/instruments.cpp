#include "ifov/instruments.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "io/document/document.h"
#include "io/json/document_parts.h"
#include "session/facade/access.h"
#include "session/facade/document_inside.h"
#include "session/shared_scene.h"

namespace ifov {
namespace {

/// What moves is built for as long as a camera looks, which each does as long as it does.
bool can_be_shared(const io::Document& document) {
  const auto& objects = document.scene.objects;
  return session::SharedScene::serves(document) &&
         std::none_of(objects.begin(), objects.end(),
                      [](const auto& object) { return object.motion != nullptr; });
}

/// What goes wrong with an instrument names it.
template <class Action>
auto named(const std::string& name, Action&& action) {
  const auto text = [&](const std::exception& error) {
    return format("instrument '{}': {}", name, error.what());
  };
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(text(error), error.position());
  } catch (const SystemError& error) {
    throw SystemError(text(error));
  }
}

bool is_graver(Verdict a, Verdict b) {
  constexpr std::array kGravestFirst{Verdict::time_limit, Verdict::unconverged, Verdict::warned,
                                     Verdict::done};
  const auto rank = [&](Verdict of) {
    return std::find(kGravestFirst.begin(), kGravestFirst.end(), of) - kGravestFirst.begin();
  };
  return rank(a) < rank(b);
}

Document chosen(const std::filesystem::path& file, std::vector<std::string> set, const std::string& name) {
  set.push_back("instrument=" + name);
  return Document::read(file, set);
}

}  // namespace

std::vector<std::string> instruments_of(const std::filesystem::path& file,
                                        const std::vector<std::string>& set) {
  std::vector<io::DocumentOverride> overrides;
  for (const std::string& written : set) overrides.push_back(io::read_override(written));
  return io::names_of_instruments(io::read_document_text(file.string()), file.string(), overrides);
}

InstrumentsOutcome render_instruments(const std::filesystem::path& file, const std::vector<std::string>& set,
                                      const InstrumentsOptions& options) {
  const std::vector<std::string> names = instruments_of(file, set);
  if (names.empty())
    throw InputError(
        format("{}: the document has no 'instruments' to choose among, or one is chosen", file.string()));
  if (options.load.ranks != nullptr || options.render.ranks != nullptr)
    throw InputError(
        "instruments: several are rendered by one process; start it without mpirun, or choose one (--set instrument=NAME)");
  if (options.render.share.count != 1)
    throw InputError(
        "instruments: several have no shares of tiles (--tiles); choose one (--set instrument=NAME)");
  // What is wrong with any is told before the first ray.
  std::vector<Document> documents;
  for (const std::string& name : names)
    documents.push_back(named(name, [&] { return chosen(file, set, name); }));

  session::SharedScene scene;
  scene.share_temperatures();
  InstrumentsOutcome outcome;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (options.render.deadline && std::chrono::steady_clock::now() >= *options.render.deadline) {
      outcome.left = names.size() - k;
      outcome.verdict = Verdict::time_limit;
      break;
    }
    if (options.render.log != nullptr)
      options.render.log->info(format("instrument {} ({} of {})", names[k], k + 1, names.size()));
    named(names[k], [&] {
      const bool shares = can_be_shared(FacadeAccess::inside(documents[k]).document);
      const Simulation simulation = FacadeAccess::load(documents[k], options.load, shares ? &scene : nullptr);
      if (options.strict && !simulation.warnings().empty())
        throw InputError(format("{} warning{} on loading, which --strict makes {}",
                                simulation.warnings().size(), simulation.warnings().size() == 1 ? "" : "s",
                                simulation.warnings().size() == 1 ? "an error" : "errors"));
      RenderOptions render = options.render;
      if (!render.folder.empty()) render.folder /= names[k];
      outcome.instruments.push_back({names[k], simulation.render(render)});
    });
    const Verdict verdict = outcome.instruments.back().outcome.verdict;
    if (is_graver(verdict, outcome.verdict)) outcome.verdict = verdict;
  }
  return outcome;
}

}  // namespace ifov
