x = convert(T, -3//73); y = 2x'; z = T[x, 17//59, 1 - 2(x + y)]; w = big"0.1"
