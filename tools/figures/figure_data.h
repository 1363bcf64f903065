#pragma once

/// Numbers for the figures of docs/, as lines of words and numbers on standard output. Each function prints one set; the
/// first word of a line says what the line is.
namespace ifov::figures {

void print_sampler_points();    ///< points that the accuracy sampler asks for in a small picture
void print_sequence();          ///< the first elements of one Owen-scrambled Sobol sequence
void print_random_positions();  ///< places at random, and densities by numbers of proposals
void print_bsdf();              ///< pi f of the models in the principal plane
void print_footprint();         ///< footprints and wings of point spread functions
void print_nodes();             ///< products of reflectances in a channel, by nodes and by integration
void print_fresnel();           ///< reflection by water
void print_sun();               ///< the Sun's way over a day, and moonlight by phase
void print_gases();             ///< vertical transmittance of gases
void print_phase();             ///< scattering matrices
void print_round_earth();       ///< light along lines in flat layers over that about a round Earth
void print_adjacency();         ///< shares of the ground's light in the air by distance
void print_model_error();       ///< how far the band model's transmittance may be off
void print_photon_transfer();   ///< mean and variance of counts, and 1/f noise
void print_temperatures();  ///< a day of two solids in the Sun and in the shade, and what the past is worth
void print_orbit();         ///< places of a satellite in TEME and above the turning Earth
void print_image();         ///< points of a pixel in two levels, and what it takes from like ones

}  // namespace ifov::figures
