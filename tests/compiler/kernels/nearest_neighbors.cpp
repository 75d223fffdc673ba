// k nearest neighbours: a training set of labelled points is loaded into RAM, then every query gets the majority label
// of its three nearest points. Two points a clock are compared; the first found wins a tie of distances.
#include "ap_int.h"
#include "hls_stream.h"

#define DIMENSIONS 4
#define TRAINING 64
#define LANES 2
#define NEIGHBORS 3
#define LABELS 4

typedef ap_int<8> feature_t;
typedef ap_uint<18> distance_t;
typedef ap_uint<2> label_t;

struct point_t {
  feature_t x[DIMENSIONS];
};
struct labelled_t {
  point_t point;
  label_t label;
};
struct candidate_t {
  distance_t distance;
  label_t label;
};

static distance_t squared_distance(const point_t& a, const point_t& b) {
#pragma HLS INLINE
  distance_t sum = 0;
  for (int d = 0; d < DIMENSIONS; ++d) {
#pragma HLS UNROLL
    const ap_int<9> difference = a.x[d] - b.x[d];
    sum += difference * difference;
  }
  return sum;
}

static void insert(candidate_t best[NEIGHBORS], const candidate_t& c) {
#pragma HLS INLINE
  for (int i = NEIGHBORS - 1; i >= 0; --i) {
#pragma HLS UNROLL
    if (c.distance < best[i].distance) {
      if (i + 1 < NEIGHBORS) best[i + 1] = best[i];
      best[i] = c;
    }
  }
}

void nearest_neighbors(hls::stream<labelled_t>& training, hls::stream<point_t>& queries, hls::stream<label_t>& answers,
                       int count) {
#pragma HLS INTERFACE axis port = training
#pragma HLS INTERFACE axis port = queries
#pragma HLS INTERFACE axis port = answers
#pragma HLS INTERFACE s_axilite port = count
#pragma HLS INTERFACE s_axilite port = return
  labelled_t points[TRAINING / LANES][LANES];
#pragma HLS ARRAY_PARTITION variable = points complete dim = 2

load:
  for (int i = 0; i < TRAINING / LANES; ++i) {
    for (int lane = 0; lane < LANES; ++lane) {
#pragma HLS PIPELINE II = 1
      points[i][lane] = training.read();
    }
  }

query:
  for (int q = 0; q < count; ++q) {
    point_t wanted;
    candidate_t best[NEIGHBORS];
#pragma HLS ARRAY_PARTITION variable = best complete
    for (int i = 0; i < NEIGHBORS; ++i) {
      best[i].distance = -1;
      best[i].label = 0;
    }
  search:
    for (int i = 0; i < TRAINING / LANES; ++i) {
#pragma HLS PIPELINE II = 1
      if (i == 0) wanted = queries.read();
      for (int lane = 0; lane < LANES; ++lane) {
#pragma HLS UNROLL
        candidate_t c;
        c.distance = squared_distance(points[i][lane].point, wanted);
        c.label = points[i][lane].label;
        insert(best, c);
      }
    }
    ap_uint<2> votes[LABELS] = {0, 0, 0, 0};
    for (int i = 0; i < NEIGHBORS; ++i) votes[best[i].label]++;
    label_t winner = best[0].label;  // all different: the nearest
    for (int l = 0; l < LABELS; ++l) {
      if (votes[l] >= 2) winner = l;
    }
    answers.write(winner);
  }
}
