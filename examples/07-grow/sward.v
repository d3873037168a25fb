/* Drawing of sward.l: colour 2 is leaves of clover, 3 of grass, 4 stems, 7 flowers. */
angle increment: 30
initial line width: 0.1
initial color: 4
contour sides: 6
surface: c clover.s 1 3 5
surface: g grass.s 1 3 5
