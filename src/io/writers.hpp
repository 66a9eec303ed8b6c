// The writers of the table of formats (formats.cpp).
#pragma once
#include "core/packing.hpp"
#include "io/files.hpp"
#include "io/output_file.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

void write_plain(const Packing &p, const Beside &beside, OutputFile &file);
void write_xyz(const Packing &p, const Beside &beside, OutputFile &file);
void write_lammps(const Packing &p, const Beside &beside, OutputFile &file);
void write_points(const Packing &p, const Beside &beside, OutputFile &file);  // VTP

void write_contacts_csv(const Packing &p, const ContactNetwork &net, OutputFile &file);
void write_contacts_dump(const Packing &p, const ContactNetwork &net, OutputFile &file);
void write_contacts_vtp(const Packing &p, const ContactNetwork &net, OutputFile &file);

}  // namespace jam::inside
