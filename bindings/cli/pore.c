/* What export writes of the pore space: mesh, image, and tables as text with one header line and 17 digits. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "jam-pack.h"

/* The walls alone, in a file of their own: programs give them conditions of their own. */
static int write_walls(const jam_system *sys, const options *o) {
  jam_mesh_options mesh;
  jam_mesh_report r = {.struct_size = sizeof r};
  jam_mesh_options_init(&mesh, sizeof mesh);
  mesh.edge = o->stl_edge;
  mesh.walls = JAM_MESH_WALLS;
  if (has_failed(jam_write_stl(sys, o->stl_walls, &mesh, &r))) return -1;
  if (!o->quiet && !o->json) printf("  walls     %lld triangles\n", (long long)r.triangles);
  return 0;
}

/* A number of bytes in the unit that fits: 112 kB. */
static const char *in_bytes(double bytes, char text[32]) {
  static const char *const units[] = {"bytes", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; bytes >= 999.5 && unit < 4; ++unit) bytes /= 1000.0;
  snprintf(text, 32, "%.3g %s", bytes, units[unit]);
  return text;
}

/* The size of the file is said before the work. */
static int write_mesh(const jam_system *sys, const options *o) {
  jam_mesh_options mesh;
  jam_mesh_report r = {.struct_size = sizeof r};
  char size[32];
  jam_mesh_options_init(&mesh, sizeof mesh);
  mesh.edge = o->stl_edge;
  if (isfinite(o->stl_shrink)) mesh.contacts = JAM_MESH_SHRUNK, mesh.factor = o->stl_shrink;
  if (isfinite(o->stl_bridge)) mesh.contacts = JAM_MESH_BRIDGED, mesh.bridge = o->stl_bridge;
  if (isfinite(o->stl_bridge_gap)) mesh.bridge_gap = o->stl_bridge_gap;
  if (has_failed(jam_write_stl(sys, NULL, &mesh, &r))) return -1;
  if (!o->quiet)
    complain("the mesh has about %.2g triangles, %s", (double)r.triangles, in_bytes((double)r.bytes, size));
  if (has_failed(jam_write_stl(sys, o->stl, &mesh, &r))) return -1;
  if (isfinite(o->stl_bridge) && r.bridges == 0) complain("warning: %s has no bridge: %s", o->stl, jam_last_error());
  if (!o->quiet && !o->json)
    printf("  mesh      %lld triangles, %s, volume %.6g of exactly %.6g\n", (long long)r.triangles,
           in_bytes((double)r.bytes, size), r.volume, r.solid);
  return 0;
}

/* The size of the file is said before the work. */
static int write_image(const jam_system *sys, const options *o) {
  jam_voxel_options image;
  jam_voxel_report r = {.struct_size = sizeof r};
  char size[32];
  jam_voxel_options_init(&image, sizeof image);
  if (isfinite(o->voxel_size)) image.size = o->voxel_size;
  image.lines = (int32_t)o->voxel_lines;
  if (has_failed(jam_voxels(sys, &image, &r, NULL, 0, NULL))) return -1;
  if (!o->quiet)
    complain("the image has %d x %d x %d voxels, %s", (int)r.nx, (int)r.ny, (int)r.nz, in_bytes((double)r.bytes, size));
  if (has_failed(jam_write_voxels(sys, o->voxels, &image, &r))) return -1;
  if (!o->quiet && !o->json) printf("  image     porosity %.9f\n", r.porosity);
  return 0;
}

/* Rows of doubles that a call has filled. */
static void print_rows(FILE *f, const char *lead, const double *table, size_t len, size_t columns) {
  size_t k;
  for (k = 0; k < len; ++k) {
    if (k % columns == 0) fputs(lead, f);
    if (isfinite(table[k])) fprintf(f, "%.17g", table[k]);
    fputc(k % columns == columns - 1 ? '\n' : ',', f);
  }
}

static double *room(size_t count) {
  double *const table = malloc((count + 1) * sizeof *table);
  if (!table) complain("out of memory");
  return table;
}

/* Slabs along each axis, then shells where the container is round. */
static int write_profile(const jam_system *sys, const options *o) {
  enum { COLUMNS = JAM_PROFILE_SOLID + 1 };
  const size_t len = (size_t)o->profile_bins * COLUMNS;
  double *const table = room(len);
  const jam_info info = info_of(sys);
  output out;
  int axis, bad = !table || open_output(&out, o->profile);
  if (!bad) {
    const int last = info.container ? info.dim : info.dim - 1;
    fputs("axis,low,high,solid\n", out.file);
    for (axis = 0; axis <= last && !bad; ++axis) {
      const char lead[] = {axis == info.dim ? 'r' : (char)('x' + axis), ',', '\0'};
      bad = has_failed(jam_solid_profile(sys, axis, (int32_t)o->profile_bins, JAM_PROFILE_COLUMNS, table, len, NULL));
      if (!bad) print_rows(out.file, lead, table, len, COLUMNS);
    }
    bad |= close_output(&out);
  }
  free(table);
  return bad ? -1 : 0;
}

/* 1 where Ctrl-C or --wall-time came first. */
static int write_pores(jam_system *sys, const options *o) {
  const size_t len = (size_t)o->pore_points * (JAM_PORE_RADIUS + 1);
  double *const table = room(len);
  output out;
  jam_status status;
  int bad = -1;
  if (!table) return -1;
  status = jam_pore_sizes(sys, o->pore_points, o->pore_seed, JAM_PORE_COLUMNS, table, len, NULL);
  if (status == JAM_CANCELLED) {
    complain("%s is not written: Ctrl-C or --wall-time came before it was computed", o->pores);
    note_omitted(o->pores);
    bad = 1;
  } else if (!has_failed(status) && !open_output(&out, o->pores)) {
    fputs("x,y,z,distance,radius\n", out.file);
    print_rows(out.file, "", table, len, JAM_PORE_RADIUS + 1);
    bad = close_output(&out);
  }
  free(table);
  return bad;
}

static int write_coordination(const jam_system *sys, const options *o) {
  size_t n = 0, k;
  int32_t *z = NULL;
  output out;
  int bad = has_failed(jam_near_coordination(sys, o->near_gap, NULL, 0, &n));
  if (!bad && !(z = malloc((n + 1) * sizeof *z))) complain("out of memory");
  bad = bad || !z || has_failed(jam_near_coordination(sys, o->near_gap, z, n, NULL)) ||
        open_output(&out, o->near_coordination);
  if (!bad) {
    fputs("sphere,z\n", out.file);
    for (k = 0; k < n; ++k) fprintf(out.file, "%zu,%d\n", k, (int)z[k]);
    bad = close_output(&out);
  }
  free(z);
  return bad ? -1 : 0;
}

int write_pore_space(jam_system *sys, const options *o) {
  const int bad[] = {o->stl ? missing(o->stl, write_mesh(sys, o)) : 0,
                     o->stl_walls ? missing(o->stl_walls, write_walls(sys, o)) : 0,
                     o->voxels ? missing(o->voxels, write_image(sys, o)) : 0,
                     o->profile ? missing(o->profile, write_profile(sys, o)) : 0,
                     o->near_coordination ? missing(o->near_coordination, write_coordination(sys, o)) : 0,
                     o->pores ? missing(o->pores, write_pores(sys, o)) : 0};
  int worst = 0, k;
  for (k = 0; k < (int)(sizeof bad / sizeof *bad); ++k)
    if (bad[k] && worst >= 0) worst = bad[k];
  return worst;
}
