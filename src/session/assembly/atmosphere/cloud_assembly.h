#pragma once

#include <memory>
#include <string>
#include <vector>

namespace ifov::atmosphere {
struct ParticleLayer;
struct Profile;
}  // namespace ifov::atmosphere
namespace ifov::io {
struct CloudDocument;
struct DocumentSources;
}  // namespace ifov::io

namespace ifov::session {

/// A document's clouds over ground at an altitude. Throws InputError, at the cloud's place in the document, where it lies inside
/// the ground, has more depth than is solved, or another substance than there can be.
std::vector<std::shared_ptr<const atmosphere::ParticleLayer>> assemble_clouds(
    const io::DocumentSources& sources, const std::vector<io::CloudDocument>& written, double ground_km);

/// What a document says of a cloud, for people: "water from 1 to 2 km, optical depth 10 (63 g/m2), effective radius 10 um".
std::string cloud_statement(const io::CloudDocument& cloud);

/// Of droplets in air too cold for them and crystals in air too warm, for people.
std::vector<std::string> cloud_remarks(const std::vector<io::CloudDocument>& clouds,
                                       const atmosphere::Profile& profile);

}  // namespace ifov::session
