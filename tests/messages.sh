#!/usr/bin/env bash
# Holds docs/messages.md to the sources. Each pattern in the first column of its tables, in backticks, is cut at its "…": every piece must
# be in a string of the sources. Each name that a refusal starts with ("Map", "--start"), and the longest fixed text of each throw, must be
# in a pattern.
# Usage: messages.sh [--list], which prints the names and texts by file instead.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
find include examples -name '*.[ch]pp' | LC_ALL=C sort | perl -CSD -Mutf8 -e '
  use strict;
  my $list = @ARGV && $ARGV[0] eq "--list";
  my @files = <STDIN>;
  chomp @files;
  open(my $doc_file, "<", "docs/messages.md") or die "docs/messages.md: $!\n";
  my @patterns;
  while (<$doc_file>) {
    next unless /^\| (.*?) \|/;
    push @patterns, $1 =~ /`([^`]+)`/g;
  }
  die "docs/messages.md: holds no patterns\n" unless @patterns or $list;

  my $literal = qr/"((?:[^"\\]|\\.)*)"/;
  my ($strings, @names, @texts) = ("");
  for my $file (@files) {
    open(my $source, "<", $file) or die "$file: $!\n";
    my $text = join "", grep { !m{^\s*(//|#include)} } <$source>;
    $text =~ s/R"\w*\(.*?\)\w*"/""/gs;
    $text =~ s/\x27(\\.|[^\\])\x27/0/g;  # letters
    $text =~ s/"\s*\n\s*"//g;            # what the compiler joins
    $strings .= "$1\n" while $text =~ /$literal/g;
    # A call reaches to the semicolon that ends its statement, but for those in strings.
    my $statement = qr/(?:[^";]|$literal)*/;
    my $is_io = $file =~ m{/io/|examples/(plot|experiment)/};
    while ($text =~ /\b(throw\b|throw_invalid\(|require\w*\(|fail\()(?=($statement);)/g) {
      my ($word, $call) = ($1, $2);
      my @literals;
      push @literals, $1 while $call =~ /$literal/g;
      next unless @literals;
      if ($word eq "throw" || ($word eq "fail(" && $is_io)) {
        my ($longest) = sort { length($b) <=> length($a) } @literals;
        push @texts, [$file, $longest];
      } elsif ($word eq "require(") {  # a condition comes first
        my ($option) = grep { /^--/ } @literals;
        my ($before) = $call =~ /^([^"]*)/;
        next if $before =~ /,\s*(where|who)\b/;
        push @names, [$file, $1] if ($option // $literals[0]) =~ /^(--[\w-]+|[A-Za-z]\w*)/;
      } elsif ($call =~ /^\s*"(\w+)/) {
        push @names, [$file, $1];
      }
    }
  }
  sub plain { my $t = shift; $t =~ s/\\(["\\])/$1/g; $t =~ s/\\n/ /g; return $t }
  $strings = plain($strings);
  if ($list) {
    my %seen;
    print "$_->[0]\t$_->[1]\n" for grep { !$seen{"@$_"}++ } @names, @texts;
    exit 0;
  }
  my $failures = 0;
  for my $pattern (@patterns) {
    for my $piece (split /…/, $pattern) {
      next if length $piece < 3 || index($strings, $piece) >= 0;
      print STDERR "docs/messages.md: \"$piece\" of `$pattern` is in no string of the sources\n";
      ++$failures;
    }
  }
  my %told;
  for (@names) {
    my ($file, $name) = @$_;
    next if grep { /(?<![\w-])\Q$name\E(?![\w-])/ } @patterns;
    print STDERR "$file: $name, which a refusal starts with, is not in docs/messages.md\n" unless $told{$name}++;
    ++$failures;
  }
  for (@texts) {
    my ($file, $text) = ($_->[0], plain($_->[1]));
    $text =~ s/^\s+|\s+$//g;
    next if length $text < 3 || grep { index($_, $text) >= 0 } @patterns;
    print STDERR "$file: \"$text\", which is thrown, is not in docs/messages.md\n" unless $told{$text}++;
    ++$failures;
  }
  exit($failures > 0);
' -- "$@"
