/** A number in four significant digits, with a true minus sign; very large and very small ones as powers of ten. */
export function fourDigits(value: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) {
    const [digits = "", exponent = ""] = value.toExponential(3).split("e");
    return `${minus(digits)} × 10${raised(Number(exponent))}`;
  }
  return minus(String(Number(value.toPrecision(4))));
}

/** A number in a fixed number of decimals, so that a read-out does not change its width; no negative zero. */
export function decimals(value: number, count: number): string {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(count);
  return minus(Number(text) === 0 ? text.replace("-", "") : text);
}

/** Reads a number as pages print it: with a true minus sign, thousands apart, a unit behind; NaN where there is none. */
export function readNumber(text: string): number {
  const plain = text.replace(/\u2212/g, "-").replace(/(\d)[\u2009\u202f](?=\d)/g, "$1");
  const found = /[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?/i.exec(plain);
  return found === null ? NaN : Number(found[0]);
}

function minus(text: string): string {
  return text.replace("-", "\u2212");
}

const SUPERSCRIPTS = ["⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"];

function raised(exponent: number): string {
  const digits = String(Math.abs(exponent)).replace(/\d/g, (digit) => SUPERSCRIPTS[Number(digit)] ?? "");
  return exponent < 0 ? `⁻${digits}` : digits;
}
