# Holds what a benchmark printed here against what it printed elsewhere. Reads `here` and `there` files, as many goes of
# each as there are, with `side` set before each (`side=here a b side=there c d`), and prints a row for each figure that
# both have: the median here, the median there, and how many times worse here is. Rates (…/s) are worse when smaller.
# `limit`: a ratio above it is marked.
BEGIN { FS = "|" }

function numbers(cell, list,    count, text) {
  sub(/\(.*/, "", cell)
  count = 0
  while (match(cell, /[0-9]+(\.[0-9]+)?/)) {
    list[++count] = substr(cell, RSTART, RLENGTH)
    cell = substr(cell, RSTART + RLENGTH)
  }
  return count
}

function median(key,    n, i, j, v, swap) {
  n = count_of[key]
  for (i = 1; i <= n; ++i) v[i] = value_of[key, i] + 0
  for (i = 2; i <= n; ++i)
    for (j = i; j > 1 && v[j] < v[j - 1]; --j) { swap = v[j]; v[j] = v[j - 1]; v[j - 1] = swap }
  return v[int((n + 1) / 2)]
}

FNR == 1 { delete head }
/^\|[-|]+$/ { for (i = 2; i < NF; ++i) head[i] = before[i]; next }
/^\|/ {
  for (i = 2; i < NF; ++i) { before[i] = $i; gsub(/^ +| +$/, "", before[i]) }
  if (before[2] == "") next  # the names of the columns
  for (column = 3; column < NF; ++column) {
    n = numbers($column, found)
    for (k = 1; k <= n; ++k) {
      name = before[2] (head[column] == "" ? "" : " | " head[column]) (n > 1 ? " | " k : "")
      if (!(name in known)) { known[name] = 1; order[++names] = name; rate[name] = $column ~ /\/s/ }
      key = side SUBSEP name
      value_of[key, ++count_of[key]] = found[k]
    }
  }
}

END {
  print "| figure | here | there | times as bad | |"
  print "|---|---|---|---|---|"
  for (i = 1; i <= names; ++i) {
    name = order[i]
    here = "here" SUBSEP name
    there = "there" SUBSEP name
    if (!count_of[here] || !count_of[there]) { alone[++others] = name (count_of[here] ? " (only here)" : " (only there)"); continue }
    a = median(here)
    b = median(there)
    if (a <= 0 || b <= 0) continue
    ratio = rate[name] ? b / a : a / b
    printf "| %s | %s | %s | %.2f | %s |\n", name, a, b, ratio, (ratio > limit ? "above " limit : "")
    above += ratio > limit
  }
  for (i = 1; i <= others; ++i) print "\nnot compared: " alone[i]
  printf "\n%d above %s\n", above, limit
}
