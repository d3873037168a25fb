/* Drawing of vine.l: colour 1 is wood, 2 leaves, 4 shoots, 5 the trellis, 8 grapes. */
angle increment: 30
initial line width: 4
initial color: 1
contour sides: 8
surface: l vine.s 1 3 5
