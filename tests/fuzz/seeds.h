#pragma once

#include <string>
#include <vector>

namespace ifov::fuzz {

/// Small good files of each format.
std::vector<std::string> obj_seeds();
std::vector<std::string> ply_seeds();
std::vector<std::string> gltf_seeds();
std::vector<std::string> glb_seeds();
std::vector<std::string> city_json_seeds();
std::vector<std::string> document_seeds();
std::vector<std::string> ecostress_seeds();
std::vector<std::string> usgs_seeds();
std::vector<std::string> usgs_column_seeds();
std::vector<std::string> asd_seeds();
std::vector<std::string> sli_header_seeds();
std::vector<std::string> ems_seeds();
std::vector<std::string> table_seeds();
std::vector<std::string> channel_seeds();
std::vector<std::string> envi_header_seeds();
std::vector<std::string> instance_file_seeds();
std::vector<std::string> body_record_seeds();
std::vector<std::string> scene_cache_seeds();
std::vector<std::string> geotiff_seeds();
std::vector<std::string> raster_seeds();

}  // namespace ifov::fuzz
