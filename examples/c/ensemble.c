/* Many seeds on two threads, one system each: a handle belongs to one thread at a time, different handles are
 * independent. Build: cc ensemble.c $(pkg-config --cflags --libs jam) -pthread -lm */
#include <jam/jam.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>

enum { SEEDS = 8, THREADS = 2, N = 128 };
static double phi[SEEDS]; /* 0: not jammed */

static void pack(int64_t seed) {
  jam_create_options create;
  jam_compress_options grow;
  jam_crunch_report report;
  jam_start start = {.struct_size = sizeof start};
  jam_system *sys = NULL;
  double size[N];
  int k;
  for (k = 0; k < N; ++k) size[k] = k < N / 2 ? 1.0 : 1.4;
  start.diameters = size;
  start.diameters_len = N;
  jam_create_options_init(&create, sizeof create);
  create.n = N;
  create.dim = 2;
  create.seed = seed; /* the same seed gives the same bits, on any thread */
  jam_compress_options_init(&grow, sizeof grow);
  grow.growth_rate = 3e-2;
  grow.pressure = 1e4;
  report.struct_size = sizeof report;
  if (jam_create(&create, &start, &sys) < 0 || jam_compress(sys, &grow, NULL) < 0 || jam_crunch(sys, NULL, &report) < 0)
    fprintf(stderr, "seed %lld: %s\n", (long long)seed, jam_last_error()); /* the text is this thread's own */
  else if (report.jammed)
    phi[seed - 1] = report.packing_fraction;
  jam_destroy(sys);
}

static void *work(void *first) {
  int64_t seed;
  for (seed = *(int64_t *)first; seed <= SEEDS; seed += THREADS) pack(seed);
  return NULL;
}

int main(void) {
  pthread_t thread[THREADS];
  int64_t first[THREADS];
  double sum = 0, squares = 0;
  int k, jammed = 0;
  for (k = 0; k < THREADS; ++k) {
    first[k] = k + 1;
    if (pthread_create(&thread[k], NULL, work, &first[k])) return 1;
  }
  for (k = 0; k < THREADS; ++k) pthread_join(thread[k], NULL);
  for (k = 0; k < SEEDS; ++k) {
    printf("seed %d: phi_J %.9f\n", k + 1, phi[k]);
    jammed += phi[k] > 0;
    sum += phi[k];
    squares += phi[k] * phi[k];
  }
  if (jammed < 2) return 1;
  printf("%d of %d jammed, phi_J = %.5f +- %.5f\n", jammed, SEEDS, sum / jammed,
         sqrt(fmax(0.0, squares / jammed - sum * sum / jammed / jammed) / (jammed - 1)));
  return 0;
}
