/** Splits text into runs of digits and runs of anything else. */
const RUNS = /\d+|\D+/g;

/**
 * Compares texts the way a person orders them: runs of digits by value, so that `J2` comes before `J10`; everything else
 * by code units, upper and lower case alike unless nothing else differs.
 */
export function naturalOrder(a: string, b: string): number {
  const left = a.toLowerCase().match(RUNS) ?? [];
  const right = b.toLowerCase().match(RUNS) ?? [];
  for (let i = 0; i < Math.min(left.length, right.length); i += 1) {
    const x = left[i] ?? "";
    const y = right[i] ?? "";
    const order = isDigits(x) && isDigits(y) ? orderOfDigits(x, y) : orderOfText(x, y);
    if (order !== 0) return order;
  }
  return left.length - right.length || orderOfText(a, b);
}

function isDigits(run: string): boolean {
  const code = run.charCodeAt(0);
  return code >= 48 && code <= 57;
}

/** By value, without a limit on the number of digits. */
function orderOfDigits(x: string, y: string): number {
  const a = x.replace(/^0+(?=\d)/, "");
  const b = y.replace(/^0+(?=\d)/, "");
  return a.length - b.length || orderOfText(a, b) || x.length - y.length;
}

function orderOfText(x: string, y: string): number {
  if (x === y) return 0;
  return x < y ? -1 : 1;
}
